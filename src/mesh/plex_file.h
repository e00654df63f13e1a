// A gmsh file as a DMPlex on one rank, with errors that can be caught.
#pragma once
#include <petscdmplex.h>

#include <string>
#include <vector>

#include "base/petsc.h"
#include "mesh/gmsh_header.h"

namespace windhover::mesh {

using DmHandle = Handle<DM, DMDestroy>;

/// Reads on this rank alone: an error in the middle of a file must not leave other ranks waiting.
/// Faces and edges are built; physical tags are in the labels "Cell Sets" and "Face Sets". UserError if unreadable.
DmHandle load_plex(const std::string& file, const GmshHeader& header);

/// The physical tag of each point in [begin, end), 0 where it has none.
std::vector<PetscInt> physical_tags(DM dm, const char* label, PetscInt begin, PetscInt end);

/// The corners of a cell in gmsh's order, with the positions of the cell's own periodic images.
struct PlexCorners {
  int size = 0;
  PetscInt vertex[8];
  double position[8][3];
};
PlexCorners corners_of(DM dm, PetscInt cell);

}  // namespace windhover::mesh
