// From the whole mesh on rank 0 to a part on each rank: its own cells and the halo around them.
#pragma once
#include <set>
#include <string>
#include <vector>

#include "mesh/file_mesh.h"

namespace windhover::mesh {

/// Cells of one rank in no particular order: owned, then halo cells behind a face, then halo cells behind a node (see
/// Mesh). Neighbours are positions in this list, -1 where the neighbour is not in it.
struct MeshPart {
  std::vector<FileCell> cells;
  std::vector<PetscSFNode> owner;  ///< of each cell: rank, and position in that rank's list
  Index n_owned = 0, n_gradient = 0;
};

/// Collective. The mesh is given on rank 0; divided by PTSCOTCH over neighbours by faces and across the surfaces named in
/// `sliding` (the same on all ranks), whose faces are known to take work.
MeshPart distribute(const FileMesh& whole, const std::set<std::string>& sliding, MPI_Comm comm);

}  // namespace windhover::mesh
