#include "mesh/number_cells.h"

#include <algorithm>
#include <numeric>

namespace windhover::mesh {
namespace {

template <class Visit>
void for_each_own_neighbour(const MeshPart& part, Index cell, Visit visit) {
  for (const FileSide& side : part.cells[cell].sides)
    if (side.neighbour >= 0 && side.neighbour < part.n_owned) visit(side.neighbour);
}

/// Owned cells by reverse Cuthill-McKee.
std::vector<Index> reverse_cuthill_mckee(const MeshPart& part) {
  std::vector<PetscInt> start{0}, columns;
  for (Index c = 0; c < part.n_owned; ++c) {
    const auto first = static_cast<std::ptrdiff_t>(columns.size());
    columns.push_back(c);
    for_each_own_neighbour(part, c, [&](Index neighbour) { columns.push_back(neighbour); });
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
  return cells;
}

/// Zone by zone, from the cells at sliding interfaces on by Cuthill-McKee, the others by reverse Cuthill-McKee. Incomplete
/// factors in this order carry what changes at an interface to the blades and back (decisions.md).
std::vector<Index> order_owned(const MeshPart& part, const std::vector<bool>& sliding) {
  const std::vector<Index> plain = reverse_cuthill_mckee(part);
  std::vector<Index> place(part.n_owned), cells;
  for (Index i = 0; i < part.n_owned; ++i) place[plain[i]] = i;
  std::vector<bool> placed(part.n_owned);
  const auto append = [&](Index c) {
    if (!placed[c]) cells.push_back(c);
    placed[c] = true;
  };
  for (const Index c : plain)
    for (const FileSide& side : part.cells[c].sides)
      if (side.patch >= 0 && sliding[side.patch]) append(c);
  std::vector<Index> neighbours;
  for (size_t i = 0; i < cells.size(); ++i) {
    neighbours.clear();
    for_each_own_neighbour(part, cells[i], [&](Index neighbour) { neighbours.push_back(neighbour); });
    std::sort(neighbours.begin(), neighbours.end(), [&](Index a, Index b) { return place[a] < place[b]; });
    for (const Index c : neighbours) append(c);
  }
  for (const Index c : plain) append(c);
  std::stable_sort(cells.begin(), cells.end(), [&](Index a, Index b) { return part.cells[a].zone < part.cells[b].zone; });
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

Numbering number_cells(const MeshPart& part, const std::vector<bool>& sliding, MPI_Comm comm) {
  Numbering numbering;
  const PetscInt n_owned = part.n_owned;
  MPI_Scan(&n_owned, &numbering.first_global, 1, MPIU_INT, MPI_SUM, comm);
  numbering.first_global -= n_owned;
  numbering.cell = order_owned(part, sliding);
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
