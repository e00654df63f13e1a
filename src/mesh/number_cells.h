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

/// Collective. Owned cells by zone, within a zone outwards from its sliding interfaces, level by level of face neighbours, or
/// by reverse Cuthill-McKee where it has none; halo cells by their global numbers. `sliding`: whether each patch is one.
Numbering number_cells(const MeshPart& part, const std::vector<bool>& sliding, MPI_Comm comm);

}  // namespace windhover::mesh
