#include "fluid/block_matrix.h"

#include <algorithm>
#include <stdexcept>

namespace windhover::fluid {

BlockParts block_parts(Mat matrix) {
  PetscBool parallel = PETSC_FALSE;
  petsc(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(matrix), MATMPIBAIJ, &parallel));
  BlockParts p{matrix};
  if (!parallel) return p;
  petsc(MatMPIBAIJGetSeqBAIJ(matrix, &p.inside, &p.outside, &p.outside_columns));
  PetscInt size = 1;
  petsc(MatGetSize(p.outside, nullptr, &p.n_outside));
  petsc(MatGetBlockSize(matrix, &size));
  p.n_outside /= size;
  return p;
}

BlockPattern::BlockPattern(Mat matrix) : matrix_(matrix) {
  PetscBool done = PETSC_FALSE;
  petsc(MatGetRowIJ(matrix_, 0, PETSC_FALSE, PETSC_TRUE, &rows_, &start_, &column_, &done));
  if (!done) throw std::logic_error("no access to the pattern of a block matrix");
}

BlockPattern::~BlockPattern() {
  PetscBool done = PETSC_FALSE;
  MatRestoreRowIJ(matrix_, 0, PETSC_FALSE, PETSC_TRUE, &rows_, &start_, &column_, &done);
}

int BlockPattern::find(PetscInt row, PetscInt column) const {
  const PetscInt* end = column_ + start_[row + 1];
  const PetscInt* found = std::lower_bound(column_ + start_[row], end, column);
  if (found == end || *found != column) throw std::logic_error("a block is not in the matrix");
  return static_cast<int>(found - column_);
}

}  // namespace windhover::fluid
