// The final order of the cells on a rank, and their numbers over all ranks.
#pragma once
#include <vector>

#include "mesh/distribute.h"

namespace windhover::mesh {

struct Numbering {
  std::vector<Index> cell;       ///< [local] position in the part
  std::vector<Index> local;      ///< [position in the part] local number
  std::vector<PetscInt> global;  ///< [local] solver-global number
  PetscInt first_global = 0;
  SfHandle halo;  ///< as in Mesh
};

/// Collective. Owned cells by zone, zones of more than `largest_piece` cells in pieces (decisions.md), within a piece by
/// reverse Cuthill-McKee; halo cells by their global numbers.
Numbering number_cells(const MeshPart& part, MPI_Comm comm, Index largest_piece = 100000);

}  // namespace windhover::mesh
