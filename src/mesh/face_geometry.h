// Integrals over faces and cells with straight edges: pure functions of the corners' positions.
#pragma once
#include <span>

#include "mesh/mesh.h"

namespace windhover::mesh {

/// A face is the fan of triangles from the mean of its corners to its edges: that surface is the same seen from both
/// sides, and neighbours share whole edges, so closed cells close to round-off in area and in moment.
struct FaceGeometry {
  Vec3 area = Vec3::Zero();      ///< ∫ n dA, by the right-hand rule
  Vec3 moment = Vec3::Zero();    ///< ∫ r × n dA about the origin
  Vec3 centroid = Vec3::Zero();  ///< mean of the triangles' centroids, weighted by their areas
};

FaceGeometry face_geometry(std::span<const Vec3> corners);

struct CellGeometry {
  double volume = 0;  ///< negative when the corners are turned inside out
  Vec3 centroid = Vec3::Zero();
};

/// Corners in VTK's order.
CellGeometry cell_geometry(CellType type, std::span<const Vec3> corners);

}  // namespace windhover::mesh
