#include "geometry/size_field.h"

#include <algorithm>

#include "geometry/rotor.h"

namespace windhover::geometry {

SizeField::SizeField(const GeometryOptions& geometry, PointSizes airframe)
    : geometry_(geometry), airframe_(std::move(airframe)) {
  for (const RotorOptions& rotor : geometry.rotor) blades_.emplace_back(rotor, geometry.refine);
}

double SizeField::near_rotor(const RotorOptions& rotor, const Blades& blades, const Vec3& point) const {
  const RotorZoneOptions& zone = rotor.zone;
  const RotorSizeOptions& sizes = rotor.size;
  const double inside = depth(rotor, zone.radius_m, zone.from_m, zone.to_m, point);
  double size = sizes.interface_m + sizes.growth * std::abs(inside);
  if (inside >= 0) size = std::min(size, sizes.zone_m);
  if (sizes.wake_m > 0) {
    const double away =
        std::max(0.0, -depth(rotor, zone.radius_m, zone.from_m - sizes.wake_length_m, zone.from_m, point));
    size = std::min(size, sizes.wake_m + sizes.growth * away);
  }
  if (rotor.hub.radius_m > 0) {
    const double away = std::max(0.0, -depth(rotor, rotor.hub.radius_m, rotor.hub.from_m, rotor.hub.to_m, point));
    size = std::min(size, sizes.hub_m + sizes.growth * away);
  }
  return std::min(size, blades.size(point));
}

double SizeField::operator()(const Vec3& point) const {
  double size = geometry_.farfield.size_m;
  for (size_t i = 0; i < blades_.size(); ++i) size = std::min(size, near_rotor(geometry_.rotor[i], blades_[i], point));
  return std::min(size / geometry_.refine, airframe_(point));
}

}  // namespace windhover::geometry
