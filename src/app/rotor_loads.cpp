#include "app/rotor_loads.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace windhover::app {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

template <class List>
int find_name(const List& list, const std::string& name) {
  const auto found = std::find_if(list.begin(), list.end(), [&](const auto& entry) { return entry.name == name; });
  return found == list.end() ? -1 : static_cast<int>(found - list.begin());
}

/// ρ n² D⁴
double reference_thrust(double rpm, double density_kg_m3, double radius_m) {
  return density_kg_m3 * std::pow(rpm / 60, 2) * std::pow(2 * radius_m, 4);
}

}  // namespace

double thrust_coefficient(double thrust_N, double rpm, double density_kg_m3, double radius_m) {
  return rpm == 0 ? std::nan("") : thrust_N / reference_thrust(rpm, density_kg_m3, radius_m);
}

double power_coefficient(double torque_Nm, double rpm, double density_kg_m3, double radius_m) {
  return 2 * std::numbers::pi * thrust_coefficient(torque_Nm, rpm, density_kg_m3, radius_m) / (2 * radius_m);
}

std::vector<MeshRotor> mesh_rotors(const Case& c, const mesh::Mesh& mesh) {
  std::vector<MeshRotor> rotors;
  for (const auto& options : c.rotor) {
    if (options.blade.count == 0) continue;
    const auto& zone = c.zone[find_name(c.zone, options.name)];
    rotors.push_back({&options, find_name(mesh.zones, zone.name), find_name(mesh.zones, zone.parent),
                      find_name(mesh.patches, options.name + "_blades"), find_name(mesh.patches, options.name + "_hub")});
  }
  return rotors;
}

RotorLoads rotor_loads(const Case& c, const MeshRotor& rotor, const std::vector<fluid::PatchFlux>& fluxes,
                       const fluid::Frames& frames) {
  const Scales scales(c.fluid);
  const mesh::FrameState &own = frames[rotor.zone], &parent = frames[rotor.parent];
  const Vec3 axis = rotor.options->axis.normalized(), thrust_axis = parent.R * axis;
  const Vec3 center = own.position(rotor.options->center_m / scales.length);
  const int spin = rotor.options->spin();
  const Vec3 start = axis.unitOrthogonal(), turned = parent.R.transpose() * (own.R * start);
  const double angle = std::atan2(axis.dot(start.cross(turned)), start.dot(turned));
  RotorLoads loads;
  loads.rpm = spin * (own.omega - parent.omega).dot(thrust_axis) / scales.time() * kDegrees / 6;
  loads.angle_deg = std::fmod(rotor.options->angle_deg + kDegrees * angle, 360);
  if (loads.angle_deg < 0) loads.angle_deg += 360;
  for (const int patch : {rotor.blades, rotor.hub}) {
    if (patch < 0) continue;
    const fluid::PatchFlux& flux = fluxes[patch];
    const double thrust = scales.force() * flux.force.dot(thrust_axis);
    const double torque = -spin * scales.moment() * (flux.moment - center.cross(flux.force)).dot(thrust_axis);
    loads.thrust_N += thrust;
    loads.torque_Nm += torque;
    if (patch == rotor.hub) loads.hub_thrust_N = thrust, loads.hub_torque_Nm = torque;
  }
  return loads;
}

}  // namespace windhover::app
