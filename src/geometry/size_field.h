// The size of the mesh wanted at every point of the air.
#pragma once
#include "geometry/blade.h"

namespace windhover::geometry {

class SizeField {
 public:
  explicit SizeField(const GeometryOptions& geometry);
  double operator()(const Vec3& point) const;

 private:
  GeometryOptions geometry_;
  std::vector<Blades> blades_;
};

}  // namespace windhover::geometry
