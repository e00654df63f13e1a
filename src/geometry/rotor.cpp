#include "geometry/rotor.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/errors.h"
#include "geometry/blade.h"
#include "geometry/sections.h"

namespace windhover::geometry {
namespace {

void default_to(double& value, double substitute) {
  if (value == 0) value = substitute;
}

void find_airfoil(std::string& airfoil, const std::filesystem::path& folder) {
  if (const auto file = folder / airfoil; std::filesystem::is_regular_file(file)) airfoil = file.lexically_normal();
}

template <class... Args>
[[noreturn]] void refuse(const RotorOptions& rotor, fmt::format_string<Args...> format, Args&&... args) {
  throw UserError("rotor \"{}\": {}", rotor.name, fmt::format(format, std::forward<Args>(args)...));
}

std::string text(const Vec3& p) { return fmt::format("({:.4g}, {:.4g}, {:.4g}) m", p.x(), p.y(), p.z()); }

double depth_in_zone(const RotorOptions& r, const Vec3& p) { return depth(r, r.zone.radius_m, r.zone.from_m, r.zone.to_m, p); }

/// Points on the zone's surface.
std::vector<Vec3> surface_points(const RotorOptions& rotor) {
  const Eigen::Matrix3d axes = rotor_axes(rotor);
  constexpr int around = 96, rows = 12;
  std::vector<Vec3> points;
  for (int k = 0; k < around; ++k) {
    const double angle = 2 * std::numbers::pi * k / around;
    const Vec3 out = std::cos(angle) * axes.col(0) + std::sin(angle) * axes.col(1);
    for (int i = 0; i <= rows; ++i) {
      const double f = double(i) / rows, z = rotor.zone.from_m + f * (rotor.zone.to_m - rotor.zone.from_m);
      points.push_back(rotor.center_m + z * axes.col(2) + rotor.zone.radius_m * out);
      for (const double disc : {rotor.zone.from_m, rotor.zone.to_m})
        points.push_back(rotor.center_m + disc * axes.col(2) + f * rotor.zone.radius_m * out);
    }
  }
  return points;
}

void validate_hub(const RotorOptions& rotor) {
  const HubOptions& hub = rotor.hub;
  if (hub.radius_m == 0) return;
  if (hub.to_m <= hub.from_m) refuse(rotor, "hub.to_m = {}: must be greater than hub.from_m = {}", hub.to_m, hub.from_m);
  if (const double most = 0.95 * std::min(hub.radius_m, (hub.to_m - hub.from_m) / 2); hub.rounding_m > most)
    refuse(rotor, "hub.rounding_m = {}: must be at most {:.4g}, 95 % of the radius and of half the height", hub.rounding_m, most);
  if (hub.radius_m >= rotor.zone.radius_m || hub.from_m <= rotor.zone.from_m || hub.to_m >= rotor.zone.to_m)
    refuse(rotor, "the hub pokes through its zone");
}

void validate_blades(const RotorOptions& rotor, double refine) {
  const TriangleSurface blade = Blades(rotor, refine).surface(0);
  const double clearance = 0.01 * rotor.blade.radius_m;
  for (const Vec3& p : blade.points) {
    if (depth_in_zone(rotor, p) < clearance)
      refuse(rotor, "a blade pokes through its zone, or comes nearer to it than {:.3g} m, at {}", clearance, text(p));
    if (rotor.hub.radius_m > 0 && depth(rotor, rotor.hub.radius_m, rotor.hub.from_m, rotor.hub.to_m, p) > -clearance)
      refuse(rotor, "a blade's root is in the hub, or nearer to it than {:.3g} m, at {}", clearance, text(p));
  }
}

void validate_zone(const RotorOptions& rotor, const FarfieldOptions& farfield) {
  const RotorZoneOptions& zone = rotor.zone;
  if (zone.radius_m <= 0) refuse(rotor, "zone.radius_m is needed");
  if (zone.to_m <= zone.from_m) refuse(rotor, "zone.to_m = {}: must be greater than zone.from_m = {}", zone.to_m, zone.from_m);
  for (const Vec3& p : surface_points(rotor))
    if ((p - farfield.center_m).norm() >= farfield.radius_m)
      refuse(rotor, "its zone leaves the ball mesh.farfield of radius {} m at {}", farfield.radius_m, text(p));
}

}  // namespace

double depth(const RotorOptions& rotor, double radius, double from, double to, const Vec3& point) {
  const Vec3 local = rotor_axes(rotor).transpose() * (point - rotor.center_m);
  return std::min({radius - local.head<2>().norm(), local.z() - from, to - local.z()});
}

void complete(RotorOptions& rotor, const std::filesystem::path& folder) {
  try {
    read_stations(rotor.blade, folder);
  } catch (const UserError& error) {
    refuse(rotor, "blade: {}", error.what());
  }
  if (rotor.blade.section.empty() && rotor.blade.airfoil.empty()) rotor.blade.airfoil = "naca0012";
  find_airfoil(rotor.blade.airfoil, folder);
  for (SectionOptions& section : rotor.blade.section) find_airfoil(section.airfoil, folder);
  RotorSizeOptions& size = rotor.size;
  default_to(size.span_m, 0.04 * rotor.blade.radius_m);
  default_to(size.root_m, size.span_m);
  default_to(size.tip_m, size.span_m);
  default_to(size.hub_m, rotor.hub.radius_m / 3);
  default_to(size.interface_m, 0.12 * rotor.blade.radius_m);
  default_to(size.zone_m, size.interface_m);
  if (size.wake_m > 0) default_to(size.wake_length_m, rotor.blade.radius_m);
}

void validate(const GeometryOptions& geometry) {
  for (const RotorOptions& rotor : geometry.rotor) {
    if (rotor.axis.norm() == 0) refuse(rotor, "axis = [0, 0, 0]: has no direction");
    if (rotor.blade.radius_m <= 0) refuse(rotor, "blade.radius_m is needed");
    try {
      validate_stations(rotor.blade);
      validate_sections(rotor.blade);
    } catch (const UserError& error) {
      refuse(rotor, "blade: {}", error.what());
    }
    validate_zone(rotor, geometry.farfield);
    validate_hub(rotor);
    validate_blades(rotor, geometry.refine);
    for (const RotorOptions& other : geometry.rotor) {
      if (&other == &rotor) continue;
      if (other.name == rotor.name) refuse(rotor, "there is another rotor of this name");
      for (const Vec3& p : surface_points(other))
        if (depth_in_zone(rotor, p) >= 0) refuse(rotor, "its zone overlaps that of rotor \"{}\" at {}", other.name, text(p));
    }
  }
}

}  // namespace windhover::geometry
