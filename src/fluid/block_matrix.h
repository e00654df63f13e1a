// Inside a matrix of 5x5 blocks (BAIJ): its parts on this rank, and where their blocks are kept.
#pragma once
#include "base/petsc.h"

namespace windhover::fluid {

/// Sequential BAIJ matrices: this rank's rows in its own columns, and in those of other ranks (null on one rank).
struct BlockParts {
  Mat inside = nullptr, outside = nullptr;
  const PetscInt* outside_columns = nullptr;  ///< global block columns of `outside`, ascending
  PetscInt n_outside = 0;
};
BlockParts block_parts(Mat matrix);

/// Block rows of a sequential BAIJ matrix: columns column()[start()[i]] to column()[start()[i + 1] - 1], ascending.
class BlockPattern {
 public:
  explicit BlockPattern(Mat matrix);
  ~BlockPattern();
  BlockPattern(const BlockPattern&) = delete;
  BlockPattern& operator=(const BlockPattern&) = delete;

  PetscInt rows() const { return rows_; }
  const PetscInt* start() const { return start_; }
  const PetscInt* column() const { return column_; }
  PetscInt blocks() const { return start_[rows_]; }
  /// Offset of a block, in blocks.
  int find(PetscInt row, PetscInt column) const;

 private:
  Mat matrix_;
  PetscInt rows_ = 0;
  const PetscInt *start_ = nullptr, *column_ = nullptr;
};

}  // namespace windhover::fluid
