// What lies behind each face of each cell: a neighbour in the same zone, or a patch.
#pragma once
#include <petscdmplex.h>

#include "mesh/file_mesh.h"
#include "mesh/gmsh_header.h"

namespace windhover::mesh {

/// Fills the sides of all cells and the list of patches. A face between two zones is cut into a patch of each.
/// UserError: boundary face, or face between zones, without name; named face inside a zone; periodic surfaces that are
/// not translations of each other or less than three cells apart. The cells' nodes are still vertices of dm.
void pair_faces(DM dm, const GmshHeader& header, const std::string& file, double scale, FileMesh& mesh);

/// Replaces the vertices by final nodes and points: a vertex on the cut between zones becomes a node of each zone,
/// and each periodic image of a node is a point.
void number_corners(FileMesh& mesh);

}  // namespace windhover::mesh
