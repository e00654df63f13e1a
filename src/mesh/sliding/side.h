// One side of a sliding interface: its faces, gathered on all ranks and placed on Γ.
#pragma once
#include <array>
#include <vector>

#include "mesh/mesh.h"
#include "mesh/sliding/chart.h"

namespace windhover::mesh {

/// A face of one side, at rest in the frame of its zone.
struct InterfaceFace {
  int rank = 0;    ///< owner of its cell
  Index cell = 0;  ///< local number there
  Vec3 cell_centroid = Vec3::Zero();
  int n = 0;
  std::array<Vec3, 4> corner;  ///< on Γ, counter-clockwise seen from outside
  double size = 0;             ///< area of its patch of Γ
  Vec3 area = Vec3::Zero();    ///< ∫ n dA, n out of Γ
  Vec3 moment = Vec3::Zero();  ///< ∫ r × n dA about the zone's origin
  Vec3 centroid = Vec3::Zero();
};

/// Faces are in an order that does not depend on the ranks.
struct InterfaceSide {
  int patch = 0, zone = 0;
  bool inner = true;
  std::vector<InterfaceFace> faces;
  std::vector<ChartFace> charts;
  std::vector<std::array<int, 4>> corner_node;  ///< of each face, -1 for a triangle's fourth
  std::vector<Vec3> node_in_file, node;         ///< as read, and moved onto Γ
};

/// Collective, the same on all ranks. UserError with a place, in lengths divided by `scale`: node off Γ, face across the
/// rim, folded or too coarse face, gap or overlap.
InterfaceSide gather_side(const Mesh& mesh, const RevolutionSurface& surface, int patch, bool inner, double scale);

}  // namespace windhover::mesh
