#include "app/rotors.h"

#include <algorithm>

#include "base/errors.h"
#include "geometry/rotor.h"
#include "io/options_reader.h"

namespace windhover::app {
namespace {

bool has_blades(const geometry::RotorOptions& rotor) { return rotor.blade.count > 0; }

ZoneOptions zone_of(const geometry::RotorOptions& rotor) {
  ZoneOptions zone;
  zone.name = rotor.name;
  zone.parent = "outer";
  zone.point_m = rotor.center_m;
  zone.axis = rotor.axis;
  zone.radius_m = rotor.zone.radius_m;
  zone.from_m = rotor.zone.from_m;
  zone.to_m = rotor.zone.to_m;
  zone.rate_deg_s = rotor.spin() * rotor.rpm * 6;
  return zone;
}

}  // namespace

void complete_rotors(Case& c) {
  if (std::none_of(c.rotor.begin(), c.rotor.end(), has_blades)) return;
  double smallest = std::numeric_limits<double>::infinity();
  for (auto& rotor : c.rotor) {
    if (!has_blades(rotor)) continue;
    geometry::complete(rotor, c.file.parent_path());
    c.zone.push_back(zone_of(rotor));
    c.fluid.boundary.try_emplace(rotor.name + "_blades", "wall");
    if (rotor.hub.radius_m > 0) c.fluid.boundary.try_emplace(rotor.name + "_hub", "wall");
    smallest = std::min(smallest, rotor.blade.radius_m);
  }
  c.fluid.boundary.try_emplace("farfield", "farfield");
  if (c.mesh.farfield.size_m == 0) c.mesh.farfield.size_m = c.mesh.farfield.radius_m / 5;
  if (c.mesh.min_edge_m == 0) c.mesh.min_edge_m = 1e-4 * smallest / c.mesh.refine;
  if (c.mesh.file.empty() && c.mesh.geometry.empty())
    c.mesh.file = c.file.parent_path() / fmt::format("{}_refine{}.msh", c.name, c.mesh.refine);
}

void validate_rotors(const Case& c, const toml::table& file) {
  if (!is_made_from_rotors(c)) return;
  if (c.mesh.farfield.radius_m == 0)
    throw UserError("{}: mesh.farfield.radius_m is needed around rotors", io::place(file, "mesh.farfield"));
  if (c.mesh.scale_m != 1)
    throw UserError("{}: mesh.scale_m = {}: must be 1 with rotors, which are in metres", io::place(file, "mesh.scale_m"),
                    c.mesh.scale_m);
  try {
    geometry::validate(rotor_geometry(c));
  } catch (const UserError& error) {
    throw UserError("{}: {}", io::place(file, "rotor"), error.what());
  }
}

void remove_rotor_zones(Case& c) {
  const auto is_rotor = [&](const ZoneOptions& zone) {
    return std::any_of(c.rotor.begin(), c.rotor.end(), [&](const auto& r) { return has_blades(r) && r.name == zone.name; });
  };
  std::erase_if(c.zone, is_rotor);
}

bool is_made_from_rotors(const Case& c) {
  return c.mesh.geometry.empty() && std::any_of(c.rotor.begin(), c.rotor.end(), has_blades);
}

geometry::GeometryOptions rotor_geometry(const Case& c) {
  geometry::GeometryOptions geometry{c.mesh.refine, c.mesh.farfield, {}};
  std::copy_if(c.rotor.begin(), c.rotor.end(), std::back_inserter(geometry.rotor), has_blades);
  return geometry;
}

}  // namespace windhover::app
