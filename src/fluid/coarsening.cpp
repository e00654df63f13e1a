#include "fluid/coarsening.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "fluid/aggregates.h"
#include "fluid/block_matrix.h"

namespace windhover::fluid {
namespace {

constexpr int kSize = 5, kEntries = kSize * kSize;
constexpr int kPasses = 3;  // of pairing: eight cells make one of the next level

MPI_Comm comm_of(Mat matrix) { return PetscObjectComm(reinterpret_cast<PetscObject>(matrix)); }

/// Frobenius norms of the blocks of this rank's own part, those of (i, j) and (j, i) added.
CouplingGraph couplings(Mat inside) {
  const BlockPattern pattern(inside);
  double* blocks = nullptr;
  petsc(MatSeqBAIJGetArray(inside, &blocks));
  const auto norm = [&](int at) {
    double sum = 0;
    for (int k = 0; k < kEntries; ++k) sum += blocks[size_t(at) * kEntries + k] * blocks[size_t(at) * kEntries + k];
    return std::sqrt(sum);
  };
  CouplingGraph graph;
  for (PetscInt i = 0; i < pattern.rows(); ++i) {
    for (PetscInt at = pattern.start()[i]; at < pattern.start()[i + 1]; ++at) {
      const PetscInt j = pattern.column()[at];
      if (j == i) continue;
      graph.neighbour.push_back(j);
      graph.strength.push_back(norm(at) + norm(pattern.find(j, i)));
    }
    graph.start.push_back(static_cast<int>(graph.neighbour.size()));
  }
  petsc(MatSeqBAIJRestoreArray(inside, &blocks));
  return graph;
}

/// Values of other ranks' rows, by the columns of `outside`.
std::vector<PetscInt> of_outside_columns(Mat matrix, const std::vector<PetscInt>& own) {
  const BlockParts parts = block_parts(matrix);
  if (!parts.outside) return {};
  VecHandle mine, theirs;
  IsHandle columns;
  ScatterHandle scatter;
  petsc(VecCreateMPI(comm_of(matrix), static_cast<PetscInt>(own.size()), PETSC_DETERMINE, mine.out()));
  petsc(VecCreateSeq(PETSC_COMM_SELF, parts.n_outside, theirs.out()));
  double* values = nullptr;
  petsc(VecGetArrayWrite(mine, &values));
  std::copy(own.begin(), own.end(), values);
  petsc(VecRestoreArrayWrite(mine, &values));
  petsc(ISCreateGeneral(PETSC_COMM_SELF, parts.n_outside, parts.outside_columns, PETSC_COPY_VALUES, columns.out()));
  petsc(VecScatterCreate(mine, columns, theirs, nullptr, scatter.out()));
  petsc(VecScatterBegin(scatter, mine, theirs, INSERT_VALUES, SCATTER_FORWARD));
  petsc(VecScatterEnd(scatter, mine, theirs, INSERT_VALUES, SCATTER_FORWARD));
  const double* got = nullptr;
  petsc(VecGetArrayRead(theirs, &got));
  std::vector<PetscInt> result(got, got + parts.n_outside);
  petsc(VecRestoreArrayRead(theirs, &got));
  return result;
}

/// Calls use(fine row, global fine column's aggregate, place) for the blocks of this rank: place counts those of the
/// inside part, then those of the outside part.
template <class Use>
void for_blocks(Mat fine, const std::vector<PetscInt>& own, const std::vector<PetscInt>& outside, Use&& use) {
  const BlockParts parts = block_parts(fine);
  int place = 0;
  const auto go_through = [&](Mat part, const std::vector<PetscInt>& coarse) {
    const BlockPattern pattern(part);
    for (PetscInt i = 0; i < pattern.rows(); ++i)
      for (PetscInt at = pattern.start()[i]; at < pattern.start()[i + 1]; ++at)
        use(own[i], coarse[pattern.column()[at]], place++);
  };
  go_through(parts.inside, own);
  if (parts.outside) go_through(parts.outside, outside);
}

/// Both parts' blocks of a matrix, for as long as this lives.
class Blocks {
 public:
  explicit Blocks(Mat matrix) : parts_(block_parts(matrix)) {
    petsc(MatSeqBAIJGetArray(parts_.inside, &inside));
    if (parts_.outside) petsc(MatSeqBAIJGetArray(parts_.outside, &outside));
    n_inside = BlockPattern(parts_.inside).blocks();
    if (parts_.outside) n_outside = BlockPattern(parts_.outside).blocks();
  }
  ~Blocks() {
    MatSeqBAIJRestoreArray(parts_.inside, &inside);
    if (parts_.outside) MatSeqBAIJRestoreArray(parts_.outside, &outside);
  }
  Blocks(const Blocks&) = delete;
  Blocks& operator=(const Blocks&) = delete;
  double* at(int place) const {
    return place < n_inside ? inside + size_t(place) * kEntries : outside + size_t(place - n_inside) * kEntries;
  }
  double *inside = nullptr, *outside = nullptr;
  int n_inside = 0, n_outside = 0;

 private:
  BlockParts parts_;
};

}  // namespace

Coarsening::Coarsening(Mat fine) : fine_(fine) {
  const MPI_Comm comm = comm_of(fine);
  aggregate_ = aggregate(couplings(block_parts(fine).inside), kPasses);
  const PetscInt n = aggregate_.empty() ? 0 : *std::max_element(aggregate_.begin(), aggregate_.end()) + 1;
  PetscInt first = 0;
  MPI_Exscan(&n, &first, 1, MPIU_INT, MPI_SUM, comm);
  std::vector<PetscInt> own(aggregate_.begin(), aggregate_.end());
  for (PetscInt& a : own) a += first;
  const std::vector<PetscInt> outside = of_outside_columns(fine, own);

  std::vector<std::vector<PetscInt>> columns(n);
  for_blocks(fine, own, outside, [&](PetscInt row, PetscInt column, int) { columns[row - first].push_back(column); });
  std::vector<PetscInt> n_inside(n, 0), n_outside(n, 0);
  for (PetscInt row = 0; row < n; ++row) {
    auto& c = columns[row];
    std::sort(c.begin(), c.end());
    c.erase(std::unique(c.begin(), c.end()), c.end());
    for (const PetscInt j : c) ++(j >= first && j < first + n ? n_inside : n_outside)[row];
  }
  petsc(MatCreateBAIJ(comm, kSize, kSize * n, kSize * n, PETSC_DETERMINE, PETSC_DETERMINE, 0, n_inside.data(), 0,
                      n_outside.data(), matrix_.out()));
  const double zero[kEntries] = {};
  for (PetscInt row = 0; row < n; ++row) {
    const PetscInt global = first + row;
    for (const PetscInt j : columns[row]) petsc(MatSetValuesBlocked(matrix_, 1, &global, 1, &j, zero, INSERT_VALUES));
  }
  petsc(MatAssemblyBegin(matrix_, MAT_FINAL_ASSEMBLY));
  petsc(MatAssemblyEnd(matrix_, MAT_FINAL_ASSEMBLY));

  const BlockParts parts = block_parts(matrix_);
  const BlockPattern inside_pattern(parts.inside);
  std::optional<BlockPattern> outside_pattern;
  if (parts.outside) outside_pattern.emplace(parts.outside);
  for_blocks(fine, own, outside, [&](PetscInt row, PetscInt column, int) {
    if (column >= first && column < first + n) {
      slot_.push_back(inside_pattern.find(row - first, column - first));
      return;
    }
    const PetscInt* end = parts.outside_columns + parts.n_outside;
    const auto local = std::lower_bound(parts.outside_columns, end, column) - parts.outside_columns;
    slot_.push_back(inside_pattern.blocks() + outside_pattern->find(row - first, static_cast<PetscInt>(local)));
  });
  sum_blocks();
}

void Coarsening::sum_blocks() {
  petsc(MatZeroEntries(matrix_));
  {
    const Blocks from(fine_), to(matrix_);
    for (size_t i = 0; i < slot_.size(); ++i) {
      const double* block = from.at(static_cast<int>(i));
      double* sum = to.at(slot_[i]);
      for (int k = 0; k < kEntries; ++k) sum[k] += block[k];
    }
  }
  petsc(MatAssemblyBegin(matrix_, MAT_FINAL_ASSEMBLY));
  petsc(MatAssemblyEnd(matrix_, MAT_FINAL_ASSEMBLY));
}

void Coarsening::restrict_to_coarse(Vec fine, Vec coarse) const {
  const double* from = nullptr;
  double* to = nullptr;
  petsc(VecSet(coarse, 0.0));
  petsc(VecGetArrayRead(fine, &from));
  petsc(VecGetArray(coarse, &to));
  for (size_t i = 0; i < aggregate_.size(); ++i)
    for (int k = 0; k < kSize; ++k) to[size_t(kSize) * aggregate_[i] + k] += from[kSize * i + k];
  petsc(VecRestoreArray(coarse, &to));
  petsc(VecRestoreArrayRead(fine, &from));
}

void Coarsening::prolong(Vec coarse, Vec fine) const {
  const double* from = nullptr;
  double* to = nullptr;
  petsc(VecGetArrayRead(coarse, &from));
  petsc(VecGetArrayWrite(fine, &to));
  for (size_t i = 0; i < aggregate_.size(); ++i)
    for (int k = 0; k < kSize; ++k) to[kSize * i + k] = from[size_t(kSize) * aggregate_[i] + k];
  petsc(VecRestoreArrayWrite(fine, &to));
  petsc(VecRestoreArrayRead(coarse, &from));
}

}  // namespace windhover::fluid
