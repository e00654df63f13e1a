// The faces of a rank's part as blocks of eight.
#pragma once
#include "mesh/distribute.h"
#include "mesh/number_cells.h"

namespace windhover::mesh {

/// Fills mesh.faces, the zones' ranges and the patches' blocks; cells and their geometry must be there already.
void build_faces(const MeshPart& part, const Numbering& numbering, Mesh& mesh);

}  // namespace windhover::mesh
