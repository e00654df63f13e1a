// How good a mesh is, and where it is worst.
#pragma once
#include "mesh/mesh.h"

namespace windhover::mesh {

struct Worst {
  double value = 0;
  Vec3 place = Vec3::Zero();  ///< in the mesh's own lengths and frames
};

struct Quality {
  Worst smallest_edge;
  Worst smallest_dihedral_deg;  ///< angle between two faces of a cell
  Worst largest_volume_ratio;   ///< between face neighbours
  Worst smallest_cell;          ///< cubic root of its volume
};

/// Collective; the same on all ranks.
Quality measure_quality(const Mesh& mesh);

}  // namespace windhover::mesh
