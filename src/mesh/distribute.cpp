#include "mesh/distribute.h"

#include <petscmat.h>

#include <algorithm>
#include <cstdlib>

#include "base/mpi_type.h"
#include "mesh/cell_shape.h"
#include "mesh/sliding/box_tree.h"

namespace windhover::mesh {
namespace {

using PartitioningHandle = Handle<MatPartitioning, MatPartitioningDestroy>;

int sliding_faces(const FileMesh& whole, const FileCell& cell, const std::set<std::string>& sliding) {
  return static_cast<int>(std::count_if(cell.sides.begin(), cell.sides.end(), [&](const FileSide& side) {
    return side.patch >= 0 && sliding.contains(whole.patches[side.patch].name);
  }));
}

/// Pairs of cells that an interface parts as the mesh stands in its file; both ways.
std::vector<std::vector<PetscInt>> across_interfaces(const FileMesh& whole, const std::set<std::string>& sliding) {
  std::vector<std::vector<PetscInt>> across(whole.cells.size());
  std::vector<PetscInt> cells;
  std::vector<Box> boxes;
  for (std::size_t c = 0; c < whole.cells.size(); ++c) {
    const FileCell& cell = whole.cells[c];
    if (sliding_faces(whole, cell, sliding) == 0) continue;
    cells.push_back(static_cast<PetscInt>(c));
    Box& box = boxes.emplace_back();
    for (int k = 0; k < point_count(cell.type); ++k) box.extend(cell.corners[k].position);
  }
  const BoxTree tree(boxes);
  std::vector<int> near;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    tree.find(boxes[i], near);
    for (const int j : near)
      if (whole.cells[cells[j]].zone != whole.cells[cells[i]].zone) across[cells[i]].push_back(cells[j]);
  }
  return across;
}

/// The cells as a graph of neighbours, by faces and across interfaces, all rows on rank 0.
MatHandle neighbour_graph(const FileMesh& whole, const std::set<std::string>& sliding, MPI_Comm comm) {
  const std::vector<FileCell>& cells = whole.cells;
  const auto n = static_cast<PetscInt>(cells.size());
  const std::vector<std::vector<PetscInt>> across = across_interfaces(whole, sliding);
  std::vector<PetscInt> start{0}, neighbours;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    for (const FileSide& side : cells[c].sides)
      if (side.neighbour >= 0) neighbours.push_back(side.neighbour);
    neighbours.insert(neighbours.end(), across[c].begin(), across[c].end());
    start.push_back(static_cast<PetscInt>(neighbours.size()));
  }
  PetscInt *rows = nullptr, *columns = nullptr;  // the matrix frees them
  petsc(PetscMalloc1(start.size(), &rows));
  petsc(PetscMalloc1(neighbours.size(), &columns));
  std::copy(start.begin(), start.end(), rows);
  std::copy(neighbours.begin(), neighbours.end(), columns);
  PetscInt n_all = n;
  MPI_Bcast(&n_all, 1, MPIU_INT, 0, comm);
  MatHandle graph;
  petsc(MatCreateMPIAdj(comm, n, n_all, rows, columns, nullptr, graph.out()));
  return graph;
}

/// What each cell takes of a step. At an interface its faces meet several others, in residuals, products and preconditioner.
PetscInt* cell_weights(const FileMesh& whole, const std::set<std::string>& sliding) {
  constexpr PetscInt kCell = 5, kSlidingFace = 7;  // 0.68 and 0.95 µs, Roe's flux, exact products, ilu; pieces are cut by all ranks alike
  PetscInt* weights = nullptr;
  petsc(PetscMalloc1(whole.cells.size(), &weights));
  for (std::size_t c = 0; c < whole.cells.size(); ++c)
    weights[c] = kCell + kSlidingFace * sliding_faces(whole, whole.cells[c], sliding);
  return weights;
}

/// Collective; the result is on rank 0: which rank gets each cell.
std::vector<int> partition(const FileMesh& whole, const std::set<std::string>& sliding, int n_ranks, MPI_Comm comm) {
  const std::vector<FileCell>& cells = whole.cells;
  if (n_ranks == 1) return std::vector<int>(cells.size(), 0);
  setenv("SCOTCH_PTHREAD_NUMBER", "1", 0);  // with threads, each run would get another partition
  const MatHandle graph = neighbour_graph(whole, sliding, comm);
  PartitioningHandle partitioning;
  petsc(MatPartitioningCreate(comm, partitioning.out()));
  petsc(MatPartitioningSetAdjacency(partitioning, graph));
  petsc(MatPartitioningSetType(partitioning, MATPARTITIONINGPTSCOTCH));
  petsc(MatPartitioningSetVertexWeights(partitioning, cell_weights(whole, sliding)));  // which it frees
  petsc(MatPartitioningSetNParts(partitioning, n_ranks));
  IsHandle ranks;
  petsc(MatPartitioningApply(partitioning, ranks.out()));
  const PetscInt* list = nullptr;
  petsc(ISGetIndices(ranks, &list));
  std::vector<int> rank_of(list, list + cells.size());
  petsc(ISRestoreIndices(ranks, &list));
  return rank_of;
}

/// Cuts the parts of one rank after the other out of the whole mesh (on rank 0).
class PartCutter {
 public:
  PartCutter(const std::vector<FileCell>& cells, const std::vector<int>& rank_of, int n_ranks)
      : cells_(cells), rank_of_(rank_of), owned_(n_ranks), position_in_owner_(cells.size()), position_(cells.size(), -1) {
    for (std::size_t c = 0; c < cells.size(); ++c) {
      auto& list = owned_[rank_of[c]];
      position_in_owner_[c] = static_cast<PetscInt>(list.size());
      list.push_back(static_cast<Index>(c));
    }
    find_cells_of_nodes();
  }

  MeshPart cut(int rank) {
    MeshPart part;
    chosen_ = owned_[rank];
    for (std::size_t i = 0; i < chosen_.size(); ++i) position_[chosen_[i]] = static_cast<Index>(i);
    part.n_owned = static_cast<Index>(chosen_.size());
    for (Index i = 0; i < part.n_owned; ++i)
      for (const FileSide& side : cells_[chosen_[i]].sides)
        if (side.neighbour >= 0) choose(side.neighbour);
    part.n_gradient = static_cast<Index>(chosen_.size());
    for (Index i = 0; i < part.n_gradient; ++i) choose_around_nodes(chosen_[i]);
    for (const Index c : chosen_) {
      part.cells.push_back(cells_[c]);
      part.owner.push_back({rank_of_[c], position_in_owner_[c]});
      for (FileSide& side : part.cells.back().sides)
        if (side.neighbour >= 0) side.neighbour = position_[side.neighbour];
    }
    for (const Index c : chosen_) position_[c] = -1;
    return part;
  }

 private:
  void find_cells_of_nodes() {
    for (const FileCell& cell : cells_)
      for (int i = 0; i < point_count(cell.type); ++i) {
        const auto node = static_cast<std::size_t>(cell.corners[i].node);
        if (node_start_.size() < node + 2) node_start_.resize(node + 2, 0);
        ++node_start_[node + 1];
      }
    for (std::size_t n = 1; n < node_start_.size(); ++n) node_start_[n] += node_start_[n - 1];
    node_cells_.resize(node_start_.empty() ? 0 : node_start_.back());
    std::vector<std::size_t> next = node_start_;
    for (std::size_t c = 0; c < cells_.size(); ++c)
      for (int i = 0; i < point_count(cells_[c].type); ++i)
        node_cells_[next[cells_[c].corners[i].node]++] = static_cast<Index>(c);
  }
  void choose(Index c) {
    if (position_[c] >= 0) return;
    position_[c] = static_cast<Index>(chosen_.size());
    chosen_.push_back(c);
  }
  void choose_around_nodes(Index c) {
    for (int i = 0; i < point_count(cells_[c].type); ++i) {
      const PetscInt node = cells_[c].corners[i].node;
      for (std::size_t k = node_start_[node]; k < node_start_[node + 1]; ++k) choose(node_cells_[k]);
    }
  }

  const std::vector<FileCell>& cells_;
  const std::vector<int>& rank_of_;
  std::vector<std::vector<Index>> owned_;   // of each rank
  std::vector<PetscInt> position_in_owner_;
  std::vector<Index> position_;             // in the part being cut, -1 outside
  std::vector<Index> chosen_;               // cells of the part being cut
  std::vector<std::size_t> node_start_;
  std::vector<Index> node_cells_;
};

void send(const MeshPart& part, int rank, MPI_Comm comm) {
  const MpiType cell(sizeof(FileCell), MPI_BYTE), node(sizeof(PetscSFNode), MPI_BYTE);
  const Index sizes[3] = {static_cast<Index>(part.cells.size()), part.n_owned, part.n_gradient};
  MPI_Send(sizes, 3, MPIU_INT, rank, 0, comm);
  MPI_Send(part.cells.data(), static_cast<int>(sizes[0]), cell, rank, 0, comm);
  MPI_Send(part.owner.data(), static_cast<int>(sizes[0]), node, rank, 0, comm);
}

MeshPart receive(MPI_Comm comm) {
  const MpiType cell(sizeof(FileCell), MPI_BYTE), node(sizeof(PetscSFNode), MPI_BYTE);
  Index sizes[3];
  MPI_Recv(sizes, 3, MPIU_INT, 0, 0, comm, MPI_STATUS_IGNORE);
  MeshPart part{std::vector<FileCell>(sizes[0]), std::vector<PetscSFNode>(sizes[0]), sizes[1], sizes[2]};
  MPI_Recv(part.cells.data(), static_cast<int>(sizes[0]), cell, 0, 0, comm, MPI_STATUS_IGNORE);
  MPI_Recv(part.owner.data(), static_cast<int>(sizes[0]), node, 0, 0, comm, MPI_STATUS_IGNORE);
  return part;
}

}  // namespace

MeshPart distribute(const FileMesh& whole, const std::set<std::string>& sliding, MPI_Comm comm) {
  int rank = 0, n_ranks = 1;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &n_ranks);
  const std::vector<int> rank_of = partition(whole, sliding, n_ranks, comm);
  if (rank != 0) return receive(comm);
  PartCutter cutter(whole.cells, rank_of, n_ranks);
  for (int other = 1; other < n_ranks; ++other) send(cutter.cut(other), other, comm);
  return cutter.cut(0);
}

}  // namespace windhover::mesh
