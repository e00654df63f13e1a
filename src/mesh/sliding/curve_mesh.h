// The mesh's cells and faces with their exact, curved edges on Γ.
#pragma once
#include <vector>

#include "mesh/sliding/side.h"

namespace windhover::mesh {

struct CurvedSide {
  const RevolutionSurface* surface;
  const InterfaceSide* side;
};

/// Collective. Moves the nodes of the sides onto their surfaces and gives all faces and cells that touch them the area,
/// moment, centroid and volume they have when the edges of faces on a wall or a sphere are curved. Two ranks get the same
/// bits for a face they share. UserError: a cell turned inside out by that.
void curve_mesh(Mesh& mesh, const std::vector<CurvedSide>& sides, double scale);

}  // namespace windhover::mesh
