#include "fluid/overlapping_rows.h"

#include <algorithm>
#include <memory>
#include <numeric>

#include "fluid/gas.h"

namespace windhover::fluid {
namespace {

IsHandle block_set(const std::vector<PetscInt>& rows) {
  IsHandle set;
  petsc(ISCreateBlock(PETSC_COMM_SELF, kVariables, static_cast<PetscInt>(rows.size()), rows.data(), PETSC_COPY_VALUES,
                      set.out()));
  return set;
}

/// A sequential matrix row by row.
class Part {
 public:
  explicit Part(Mat matrix) : pattern_(matrix) {
    double* blocks = nullptr;
    petsc(MatSeqBAIJGetArray(matrix, &blocks));
    blocks_ = blocks;
    petsc(MatSeqBAIJRestoreArray(matrix, &blocks));
  }
  template <class Visit>
  void for_each(int row, Visit visit) const {
    for (int at = pattern_.start()[row]; at < pattern_.start()[row + 1]; ++at)
      visit(pattern_.column()[at], blocks_ + size_t(kVariables * kVariables) * at);
  }

 private:
  BlockPattern pattern_;
  const double* blocks_ = nullptr;
};

}  // namespace

OverlappingRows::OverlappingRows(Mat matrix) : matrix_(matrix), parts_(block_parts(matrix)) {
  PetscInt first = 0, end = 0;
  petsc(MatGetOwnershipRange(matrix_, &first, &end));
  first /= kVariables;
  own_ = end / kVariables - first;
  const PetscInt *others = parts_.outside_columns, *others_end = others + parts_.n_outside;
  before_ = static_cast<int>(std::lower_bound(others, others_end, first) - others);
  after_ = parts_.n_outside - before_;
  std::vector<PetscInt> columns(others, others + before_);
  columns.resize(before_ + own_);
  std::iota(columns.begin() + before_, columns.end(), first);
  columns.insert(columns.end(), others + before_, others_end);
  if (parts_.outside) {
    other_rows_ = block_set({others, others_end});
    columns_ = block_set(columns);
    fetch(MAT_INITIAL_MATRIX);
  }
}

OverlappingRows::~OverlappingRows() {
  if (others_) MatDestroySubMatrices(1, &others_);
}

void OverlappingRows::fetch(MatReuse reuse) {
  const IS rows = other_rows_, columns = columns_;
  petsc(MatCreateSubMatrices(matrix_, 1, &rows, &columns, reuse, &others_));
}

/// Calls visit(row, column, block) row by row, columns ascending.
template <class Visit>
void OverlappingRows::for_each_block(Visit visit) const {
  const auto part = [](Mat matrix) { return matrix ? std::make_unique<Part>(matrix) : nullptr; };
  const auto inside = part(parts_.inside), outside = part(parts_.outside), others = part(others_ ? *others_ : nullptr);
  for (int row = 0; row < rows(); ++row) {
    const int own = row - before_;
    if (own < 0 || own >= own_) {
      others->for_each(own < 0 ? row : row - own_, [&](int column, const double* block) { visit(row, column, block); });
      continue;
    }
    const auto visit_outside = [&](bool after) {
      if (!outside) return;
      outside->for_each(own, [&](int column, const double* block) {
        if ((column >= before_) == after) visit(row, after ? column + own_ : column, block);
      });
    };
    visit_outside(false);
    inside->for_each(own, [&](int column, const double* block) { visit(row, before_ + column, block); });
    visit_outside(true);
  }
}

OverlappingRows::Pattern OverlappingRows::pattern() const {
  Pattern pattern{std::vector<int>(rows() + 1), {}};
  for_each_block([&](int row, int column, const double*) {
    pattern.column.push_back(column);
    pattern.start[row + 1] = static_cast<int>(pattern.column.size());
  });
  return pattern;
}

SfHandle OverlappingRows::forest(size_t size) const {
  const MPI_Comm comm = PetscObjectComm(reinterpret_cast<PetscObject>(matrix_));
  int n_ranks = 1;
  MPI_Comm_size(comm, &n_ranks);
  const PetscInt* ranges = nullptr;
  petsc(MatGetOwnershipRanges(matrix_, &ranges));
  std::vector<PetscInt> leaves;
  std::vector<PetscSFNode> roots;
  for (int k = 0; k < before_ + after_; ++k) {
    const PetscInt row = parts_.outside_columns[k];
    const auto rank = std::upper_bound(ranges, ranges + n_ranks, kVariables * row) - ranges - 1;
    roots.push_back({static_cast<PetscInt>(rank), row - ranges[rank] / kVariables});
    leaves.push_back(k < before_ ? k : static_cast<PetscInt>(size) - before_ - after_ + k);
  }
  SfHandle forest;
  petsc(PetscSFCreate(comm, forest.out()));
  petsc(PetscSFSetGraph(forest, own_, static_cast<PetscInt>(leaves.size()), leaves.data(), PETSC_COPY_VALUES,
                        roots.data(), PETSC_COPY_VALUES));
  return forest;
}

std::vector<const double*> OverlappingRows::blocks() {
  if (others_) fetch(MAT_REUSE_MATRIX);
  std::vector<const double*> blocks;
  for_each_block([&](int, int, const double* block) { blocks.push_back(block); });
  return blocks;
}

}  // namespace windhover::fluid
