// Integrals over faces with edges on Γ, in the zone's frame.
#pragma once
#include <span>

#include "mesh/sliding/chart.h"

namespace windhover::mesh {

/// Sums over the surface of a cell, or a part of it, with outward normals. The last two give the cell's volume and first
/// moment about a given point o by the divergence theorem.
struct SurfaceSums {
  double size = 0;
  Vec3 area = Vec3::Zero();      ///< ∫ n dA
  Vec3 moment = Vec3::Zero();    ///< ∫ r × n dA about the origin
  Vec3 centroid = Vec3::Zero();  ///< ∫ r dA
  double volume = 0;             ///< ⅓ ∫ (r − o)·n dA
  Vec3 first = Vec3::Zero();     ///< ½ ∫ |r − o|² n dA
};

/// The cone from the mean of the corners over the face's edges. Edge k from corner k to the next one is straight, or where
/// curve[k] is given, that surface's: a helix on the wall (an arc of the rim), a great circle on the sphere.
SurfaceSums cone_sums(std::span<const Vec3> corners, std::span<const RevolutionSurface* const> curve, const Vec3& o);

/// ½ ∫ |r − o|² n dA over a face on the wall or the sphere, in the zone's frame, n out of Γ.
Vec3 patch_first(const Chart& chart, std::span<const Vec3> outline, const Vec3& o);

}  // namespace windhover::mesh
