// The airframe in the gmsh model.
#pragma once
#include <vector>

#include "geometry/point_sizes.h"

namespace windhover::mesher {

/// surfaces: empty without an airframe.
struct AirframeModel {
  std::vector<int> surfaces;
  geometry::PointSizes sizes;  ///< wanted on it and around it, from its curvature; refined
};

/// Unites parts and STEP file into one solid; the model must be empty. UserError: no solid in the file; parts that do not touch;
/// airframe in a rotor's zone, too near to it, or outside the ball, with the place.
AirframeModel add_airframe(const geometry::GeometryOptions& geometry);

}  // namespace windhover::mesher
