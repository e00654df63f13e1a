// The size of the mesh wanted at every point of the air.
#pragma once
#include "geometry/blade.h"
#include "geometry/point_sizes.h"

namespace windhover::geometry {

class SizeField {
 public:
  /// airframe: sizes on it at its final refinement.
  SizeField(const GeometryOptions& geometry, PointSizes airframe);
  double operator()(const Vec3& point) const;

 private:
  double near_rotor(const RotorOptions& rotor, const Blades& blades, const Vec3& point) const;

  GeometryOptions geometry_;
  std::vector<Blades> blades_;
  PointSizes airframe_;
};

}  // namespace windhover::geometry
