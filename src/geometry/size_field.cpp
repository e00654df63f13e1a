#include "geometry/size_field.h"

#include <algorithm>

#include "geometry/rotor.h"

namespace windhover::geometry {

SizeField::SizeField(const GeometryOptions& geometry) : geometry_(geometry) {
  for (const RotorOptions& rotor : geometry.rotor) blades_.emplace_back(rotor, geometry.refine);
}

double SizeField::operator()(const Vec3& point) const {
  double size = geometry_.farfield.size_m;
  for (size_t i = 0; i < blades_.size(); ++i) {
    const RotorOptions& rotor = geometry_.rotor[i];
    const RotorSizeOptions& sizes = rotor.size;
    const double inside = depth(rotor, rotor.zone.radius_m, rotor.zone.from_m, rotor.zone.to_m, point);
    size = std::min(size, sizes.interface_m + sizes.growth * std::abs(inside));
    if (inside >= 0) size = std::min(size, sizes.zone_m);
    if (rotor.hub.radius_m > 0) {
      const double away = std::max(0.0, -depth(rotor, rotor.hub.radius_m, rotor.hub.from_m, rotor.hub.to_m, point));
      size = std::min(size, sizes.hub_m + sizes.growth * away);
    }
    size = std::min(size, blades_[i].size(point));
  }
  return size / geometry_.refine;
}

}  // namespace windhover::geometry
