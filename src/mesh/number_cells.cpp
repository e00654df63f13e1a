#include "mesh/number_cells.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <numeric>
#include <span>
#include <utility>

namespace windhover::mesh {
namespace {

/// Divides cells at the median of the coordinate along which they extend farthest, until pieces are small enough, and
/// numbers the pieces.
void bisect(std::span<Index> cells, Index largest, const std::vector<Vec3>& centre, std::vector<int>& piece,
            int& n_pieces) {
  if (std::ssize(cells) <= largest) {
    for (const Index c : cells) piece[c] = n_pieces;
    ++n_pieces;
    return;
  }
  Eigen::AlignedBox3d box;
  for (const Index c : cells) box.extend(centre[c]);
  Eigen::Index along = 0;
  box.sizes().maxCoeff(&along);
  const size_t half = cells.size() / 2;
  std::nth_element(cells.begin(), cells.begin() + half, cells.end(),
                   [&](Index a, Index b) { return std::pair(centre[a][along], a) < std::pair(centre[b][along], b); });
  bisect(cells.first(half), largest, centre, piece, n_pieces);
  bisect(cells.subspan(half), largest, centre, piece, n_pieces);
}

/// The piece of each owned cell, zone by zone.
std::vector<int> pieces(const MeshPart& part, Index largest) {
  std::vector<Vec3> centre(part.n_owned);  // of its corners
  std::map<int, std::vector<Index>> zones;
  for (Index c = 0; c < part.n_owned; ++c) {
    const int n = static_cast<int>(part.cells[c].type);
    Vec3 sum = Vec3::Zero();
    for (int k = 0; k < n; ++k) sum += part.cells[c].corners[k].position;
    centre[c] = sum / n;
    zones[part.cells[c].zone].push_back(c);
  }
  std::vector<int> piece(part.n_owned);
  int n_pieces = 0;
  for (auto& [zone, cells] : zones) bisect(cells, largest, centre, piece, n_pieces);
  return piece;
}

/// Reverse Cuthill-McKee over the owned cells of each piece; pieces come one after the other, and so zones.
std::vector<Index> order_owned(const MeshPart& part, Index largest_piece) {
  const std::vector<int> piece = pieces(part, largest_piece);
  std::vector<PetscInt> start{0}, columns;
  for (Index c = 0; c < part.n_owned; ++c) {
    const auto first = static_cast<std::ptrdiff_t>(columns.size());
    columns.push_back(c);
    for (const FileSide& side : part.cells[c].sides)
      if (side.neighbour >= 0 && side.neighbour < part.n_owned && piece[side.neighbour] == piece[c])
        columns.push_back(side.neighbour);
    std::sort(columns.begin() + first, columns.end());
    start.push_back(static_cast<PetscInt>(columns.size()));
  }
  std::vector<PetscScalar> values(columns.size());
  MatHandle graph;
  petsc(MatCreateSeqAIJWithArrays(PETSC_COMM_SELF, part.n_owned, part.n_owned, start.data(), columns.data(),
                                  values.data(), graph.out()));
  IsHandle rows, cols;
  petsc(MatGetOrdering(graph, MATORDERINGRCM, rows.out(), cols.out()));
  const PetscInt* order = nullptr;
  petsc(ISGetIndices(rows, &order));
  std::vector<Index> cells(order, order + part.n_owned);
  petsc(ISRestoreIndices(rows, &order));
  std::stable_sort(cells.begin(), cells.end(), [&](Index a, Index b) { return piece[a] < piece[b]; });
  return cells;
}

/// Solver-global numbers of all cells of the part, by position.
std::vector<PetscInt> global_numbers(const MeshPart& part, const Numbering& numbering, MPI_Comm comm) {
  const auto n_cells = static_cast<PetscInt>(part.cells.size());
  std::vector<PetscInt> global(n_cells, -1);
  for (Index i = 0; i < part.n_owned; ++i) global[numbering.cell[i]] = numbering.first_global + i;
  SfHandle sf;
  petsc(PetscSFCreate(comm, sf.out()));
  std::vector<PetscInt> leaves(n_cells - part.n_owned);
  std::iota(leaves.begin(), leaves.end(), part.n_owned);
  std::vector<PetscSFNode> roots(part.owner.begin() + part.n_owned, part.owner.end());
  petsc(PetscSFSetGraph(sf, part.n_owned, n_cells - part.n_owned, leaves.data(), PETSC_COPY_VALUES, roots.data(),
                        PETSC_COPY_VALUES));
  const std::vector<PetscInt> owned(global.begin(), global.begin() + part.n_owned);
  petsc(PetscSFBcastBegin(sf, MPIU_INT, owned.data(), global.data(), MPI_REPLACE));
  petsc(PetscSFBcastEnd(sf, MPIU_INT, owned.data(), global.data(), MPI_REPLACE));
  return global;
}

SfHandle halo_of(const MeshPart& part, const Numbering& numbering, MPI_Comm comm) {
  const auto n_cells = static_cast<PetscInt>(part.cells.size());
  int n_ranks = 1;
  MPI_Comm_size(comm, &n_ranks);
  std::vector<PetscInt> first(n_ranks), leaves;
  MPI_Allgather(&numbering.first_global, 1, MPIU_INT, first.data(), 1, MPIU_INT, comm);
  std::vector<PetscSFNode> roots;
  for (PetscInt i = part.n_owned; i < n_cells; ++i) {
    const PetscInt rank = part.owner[numbering.cell[i]].rank;
    leaves.push_back(i);
    roots.push_back({rank, numbering.global[i] - first[rank]});
  }
  SfHandle halo;
  petsc(PetscSFCreate(comm, halo.out()));
  petsc(PetscSFSetGraph(halo, part.n_owned, static_cast<PetscInt>(leaves.size()), leaves.data(), PETSC_COPY_VALUES,
                        roots.data(), PETSC_COPY_VALUES));
  petsc(PetscSFSetUp(halo));
  return halo;
}

}  // namespace

Numbering number_cells(const MeshPart& part, MPI_Comm comm, Index largest_piece) {
  Numbering numbering;
  const PetscInt n_owned = part.n_owned;
  MPI_Scan(&n_owned, &numbering.first_global, 1, MPIU_INT, MPI_SUM, comm);
  numbering.first_global -= n_owned;
  numbering.cell = order_owned(part, largest_piece);
  const std::vector<PetscInt> global = global_numbers(part, numbering, comm);

  const auto by_global = [&](Index a, Index b) { return global[a] < global[b]; };
  numbering.cell.resize(part.cells.size());
  const auto halo = numbering.cell.begin() + part.n_owned, far = numbering.cell.begin() + part.n_gradient;
  std::iota(halo, numbering.cell.end(), part.n_owned);
  std::sort(halo, far, by_global);
  std::sort(far, numbering.cell.end(), by_global);

  numbering.local.resize(part.cells.size());
  for (std::size_t i = 0; i < numbering.cell.size(); ++i) {
    numbering.local[numbering.cell[i]] = static_cast<Index>(i);
    numbering.global.push_back(global[numbering.cell[i]]);
  }
  numbering.halo = halo_of(part, numbering, comm);
  return numbering;
}

}  // namespace windhover::mesh
