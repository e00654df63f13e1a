#include "app/vehicle.h"

#include <algorithm>

#include "base/errors.h"
#include "base/options.h"
#include "coupling/schemes.h"
#include "geometry/mass.h"
#include "io/options_reader.h"

namespace windhover::app {
namespace {

const ZoneOptions* zone_of(const Case& c, const std::string& name) {
  const auto found = std::find_if(c.zone.begin(), c.zone.end(), [&](const auto& zone) { return zone.name == name; });
  return found == c.zone.end() ? nullptr : &*found;
}

/// What the controller knows of a rotor of the body.
control::RotorModel rotor_model(const Case& c, const body::RotorOptions& rotor, const std::string& key) {
  control::RotorModel model{.name = rotor.name};
  if (c.controller.law.kind == "none") return model;
  const auto& list = c.controller.rotor;
  const auto found = std::find_if(list.begin(), list.end(), [&](const auto& r) { return r.name == rotor.name; });
  if (found == list.end()) throw UserError("controller.rotor: none for {} \"{}\"", key, rotor.name);
  const std::string entry = fmt::format("controller.rotor[{}].", found - list.begin());
  const ZoneOptions* zone = zone_of(c, rotor.name);
  if (!found->position_m && !zone)
    throw UserError("{}position_m: is needed, since no zone is called \"{}\"", entry, rotor.name);
  if (found->thrust_axis.norm() == 0) throw UserError("{}thrust_axis: has no direction", entry);
  model.p_GR_B = (found->position_m ? *found->position_m : zone->point_m) - c.body.center_of_gravity_m;
  model.thrust_axis_B = found->thrust_axis.normalized();
  const double along = model.thrust_axis_B.dot(rotor.spin_axis.normalized());
  if (std::abs(along) < 1 - 1e-6) throw UserError("{}thrust_axis: is not parallel to the spin axis of {}", entry, key);
  model.spin = along > 0 ? 1 : -1;
  model.thrust_N_s2 = found->thrust_N_s2;
  model.torque_Nm_s2 = found->torque_Nm_s2;
  model.min_speed_rad_s = found->min_speed_rad_s;
  model.max_speed_rad_s = found->max_speed_rad_s;
  return model;
}

void validate_zones(const Case& c) {
  for (size_t i = 0; i < c.zone.size(); ++i) {
    const int j = rotor_of_zone(c, c.zone[i]);
    if (j < 0) continue;
    const ZoneOptions& zone = c.zone[i];
    if (zone_of(c, zone.parent))
      throw UserError("zone[{}].parent: \"{}\" turns itself; a rotor of the body must be in a zone that does not", i,
                      zone.parent);
    const Vec3 spin = c.body.vehicle.rotor[j].spin_axis.normalized();
    if (spin.cross(zone.axis.normalized()).norm() > 1e-6)
      throw UserError("body.rotor[{}].spin_axis: is not parallel to the axis of the zone \"{}\"", j, zone.name);
  }
  for (size_t i = 0; i < c.controller.rotor.size(); ++i) {
    const auto& rotors = c.body.vehicle.rotor;
    std::vector<std::string> names;
    for (const auto& rotor : rotors) names.push_back(rotor.name);
    const std::string& name = c.controller.rotor[i].name;
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw UserError("controller.rotor[{}].name: \"{}\" is no rotor of the body{}", i, name, suggestion(name, names));
  }
}

void complete_rotor(const Case& c, body::RotorOptions& rotor) {
  if (rotor.inertia_kg_m2 != 0) return;
  for (const geometry::RotorOptions& part : c.rotor)
    if (part.name == rotor.name && part.mass_kg > 0)
      rotor.inertia_kg_m2 = part.mass_kg * geometry::squared_radius_of_gyration(part.blade);
}

}  // namespace

void complete_vehicle(Case& c) {
  if (!is_dynamic(c)) return;
  body::VehicleOptions& vehicle = c.body.vehicle;
  for (auto& rotor : vehicle.rotor) complete_rotor(c, rotor);
  const geometry::MassProperties parts = geometry::aircraft_mass(c.airframe, c.rotor);
  if (vehicle.mass_kg != 0 || parts.mass_kg == 0) return;
  const auto& inertia = parts.inertia_kg_m2;
  vehicle.mass_kg = parts.mass_kg;
  vehicle.inertia_kg_m2 = inertia.diagonal();
  vehicle.inertia_products_kg_m2 = -Vec3(inertia(0, 1), inertia(0, 2), inertia(1, 2));
  c.body.center_of_gravity_m = parts.center_m;
}

int rotor_of_zone(const Case& c, const ZoneOptions& zone) {
  if (!is_dynamic(c)) return -1;
  const auto& rotors = c.body.vehicle.rotor;
  const auto found = std::find_if(rotors.begin(), rotors.end(), [&](const auto& r) { return r.name == zone.name; });
  return found == rotors.end() ? -1 : static_cast<int>(found - rotors.begin());
}

const ZoneOptions* zone_turned_by_time(const Case& c) {
  for (const ZoneOptions& zone : c.zone)
    if (rotor_of_zone(c, zone) < 0 && (zone.rate_deg_s != 0 || zone.amplitude_deg != 0)) return &zone;
  return nullptr;
}

coupling::VehicleModel vehicle_model(const Case& c) {
  coupling::VehicleModel model{c.body.vehicle, c.body.integrator, c.controller.law, {}};
  for (size_t j = 0; j < c.body.vehicle.rotor.size(); ++j)
    model.rotors.push_back(rotor_model(c, c.body.vehicle.rotor[j], fmt::format("body.rotor[{}]", j)));
  return model;
}

void validate_vehicle(const Case& c, const toml::table& file) {
  if (!is_dynamic(c)) return;
  try {
    const coupling::Window window(vehicle_model(c));
    validate_zones(c);
    coupling::find_scheme(c.coupling);
  } catch (const UserError& error) {
    const std::string message = error.what();
    throw UserError("{}: {}", io::place(file, message.substr(0, message.find_first_of(": "))), message);
  }
}

}  // namespace windhover::app
