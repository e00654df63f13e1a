#include "app/rotors.h"

#include <algorithm>
#include <cmath>

#include "base/errors.h"
#include "base/options.h"
#include "geometry/airframe.h"
#include "geometry/rotor.h"
#include "io/options_reader.h"

namespace windhover::app {
namespace {

bool has_blades(const geometry::RotorOptions& rotor) { return rotor.blade.count > 0; }

bool has_parts(const Case& c) { return c.airframe.is_given() || std::any_of(c.rotor.begin(), c.rotor.end(), has_blades); }

void copy_missing(toml::table& target, const toml::table& from) {
  for (const auto& [key, node] : from) {
    toml::node* there = target.get(key);
    if (there && there->is_table() && node.is_table()) copy_missing(*there->as_table(), *node.as_table());
    if (!there) node.visit([&, &k = key](const auto& value) { target.insert(k, value); });
  }
}

/// <case>_<resolution>_refine<refine>.msh; the second part only where it tells something.
std::string mesh_name(const Case& c) {
  if (c.mesh.resolution.empty()) return fmt::format("{}_refine{}.msh", c.mesh_name, c.mesh.refine);
  const std::string refine = c.mesh.refine == 1 ? "" : fmt::format("_refine{}", c.mesh.refine);
  return fmt::format("{}_{}{}.msh", c.mesh_name, c.mesh.resolution, refine);
}

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

void copy_like_rotors(toml::table& file) {
  toml::array* rotors = file["rotor"].as_array();
  std::vector<std::pair<std::string, const toml::table*>> before;
  for (size_t i = 0; rotors && i < rotors->size(); ++i) {
    toml::table* rotor = rotors->get(i)->as_table();
    if (!rotor) continue;  // the reader refuses it
    if (const auto like = (*rotor)["like"].value_or(std::string()); !like.empty()) {
      std::vector<std::string> names;
      const toml::table* found = nullptr;
      for (const auto& [name, other] : before) {
        if (name == like) found = other;
        names.push_back(name);
      }
      if (!found)
        throw UserError("{}: rotor[{}].like = \"{}\": must be the name of a rotor before it{}", io::place(*rotor->get("like")),
                        i, like, suggestion(like, names));
      copy_missing(*rotor, *found);
      rotor->erase("like");
    }
    before.emplace_back((*rotor)["name"].value_or(std::string("rotor")), rotor);
  }
}

void complete_rotors(Case& c) {
  if (!has_parts(c)) return;
  if (c.airframe.is_given()) {
    geometry::complete(c.airframe, c.file.parent_path());
    c.fluid.boundary.try_emplace("airframe", "wall");
  }
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
  if (c.mesh.min_edge_m == 0 && std::isfinite(smallest)) c.mesh.min_edge_m = 1e-4 * smallest / c.mesh.refinement();
  if (c.mesh.file.empty() && c.mesh.geometry.empty()) c.mesh.file = c.file.parent_path() / mesh_name(c);
}

void validate_rotors(const Case& c, const toml::table& file) {
  if (!is_made_from_parts(c)) return;
  if (c.mesh.farfield.radius_m == 0)
    throw UserError("{}: mesh.farfield.radius_m is needed around airframe and rotors", io::place(file, "mesh.farfield"));
  if (c.mesh.scale_m != 1)
    throw UserError("{}: mesh.scale_m = {}: must be 1 with airframe and rotors, which are in metres", io::place(file, "mesh.scale_m"),
                    c.mesh.scale_m);
  try {
    geometry::validate(c.airframe);
  } catch (const UserError& error) {
    throw UserError("{}: {}", io::place(file, "airframe"), error.what());
  }
  try {
    geometry::validate(mesh_geometry(c));
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

bool is_made_from_parts(const Case& c) { return c.mesh.geometry.empty() && has_parts(c); }

geometry::GeometryOptions mesh_geometry(const Case& c) {
  geometry::GeometryOptions geometry{c.mesh.refinement(), c.mesh.farfield, c.airframe, {}};
  std::copy_if(c.rotor.begin(), c.rotor.end(), std::back_inserter(geometry.rotor), has_blades);
  return geometry;
}

}  // namespace windhover::app
