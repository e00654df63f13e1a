// Every key of a vehicle: name, range and meaning. The defaults are those of the structs in vehicle_options.h.
#pragma once
#include "base/options.h"
#include "body/integrator.h"
#include "body/vehicle_options.h"

namespace windhover::body {

template <class V>
void declare(V& v, MotorOptions& o) {
  v.key("kind", o.kind,
        {.doc = "servo: the speed follows its command with a lag; torque: a motor that loads slow down",
         .choices = {"none", "servo", "torque"}});
  v.when("kind", o.kind, "servo",
         [&] { v.key("time_constant_s", o.time_constant_s, {.doc = "lag of the speed", .above = 0}); });
  v.when("kind", o.kind, "torque", [&] {
    v.key("torque_constant_Nm_A", o.torque_constant_Nm_A, {.doc = "torque per current", .above = 0});
    v.key("resistance_ohm", o.resistance_ohm, {.doc = "resistance of the windings", .above = 0});
    v.key("supply_V", o.supply_V, {.doc = "voltage of the supply, the most that a motor gets", .above = 0});
    v.key("friction_Nm", o.friction_Nm, {.doc = "constant friction", .min = 0});
    v.key("friction_Nm_s", o.friction_Nm_s, {.doc = "friction per speed", .min = 0});
    v.key("governor_V_s", o.governor_V_s, {.doc = "further volts per rad/s of missing speed; 0: none", .min = 0});
  });
}

template <class V>
void declare(V& v, RotorOptions& o) {
  v.key("name", o.name, {.doc = "name, by place: front_right"});
  v.key("inertia_kg_m2", o.inertia_kg_m2, {.doc = "moment of inertia about the spin axis", .above = 0});
  v.key("spin_axis", o.spin_axis, {.doc = "the rotor turns right-handed about it (body axes); any length"});
  v.key("speed_rad_s", o.speed_rad_s, {.doc = "speed at t = 0"});
  v.key("angle_rad", o.angle_rad, {.doc = "angle at t = 0"});
  v.key(
      "off_at_s", o.off_at_s,
      {.doc = "the motor has no current from then on: air and friction turn the rotor; when missing, never", .min = 0});
  v.section("motor", o.motor, "What turns the rotor.");
}

namespace keys {
constexpr const char* kFreedomDoc =
    "free, locked at its initial value, on a spring and damper, or prescribed: mean + rate t + amplitude "
    "sin(2π frequency t + phase)";
inline const std::vector<std::string> freedom_kinds = {"free", "locked", "spring", "prescribed"};

template <class V>
void harmonic(V& v, FreedomOptions& o) {
  v.key("frequency_hz", o.frequency_hz, {.doc = "frequency of the prescribed oscillation", .min = 0});
  v.key("phase_rad", o.phase_rad, {.doc = "phase of the prescribed oscillation at t = 0"});
}
}  // namespace keys

template <class V>
void declare(V& v, TranslationOptions& o) {
  v.key("kind", o.kind, {.doc = keys::kFreedomDoc, .choices = keys::freedom_kinds});
  v.key("stiffness_N_m", o.stiffness, {.doc = "force of the spring per displacement", .min = 0});
  v.key("damping_N_s_m", o.damping, {.doc = "force of the damper per velocity", .min = 0});
  v.key("preload_N", o.preload, {.doc = "force of the spring at rest_m"});
  v.key("rest_m", o.rest, {.doc = "position at which the spring gives its preload"});
  v.key("mean_m", o.mean, {.doc = "mean of the prescribed position"});
  v.key("rate_m_s", o.rate, {.doc = "steady part of the prescribed velocity"});
  v.key("amplitude_m", o.amplitude, {.doc = "amplitude of the prescribed oscillation"});
  keys::harmonic(v, o);
}

template <class V>
void declare(V& v, RotationOptions& o) {
  v.key("kind", o.kind, {.doc = keys::kFreedomDoc, .choices = keys::freedom_kinds});
  v.key("stiffness_Nm_rad", o.stiffness, {.doc = "torque of the spring per angle", .min = 0});
  v.key("damping_Nm_s_rad", o.damping, {.doc = "torque of the damper per angular velocity", .min = 0});
  v.key("preload_Nm", o.preload, {.doc = "torque of the spring at rest_rad"});
  v.key("rest_rad", o.rest, {.doc = "angle at which the spring gives its preload"});
  v.key("mean_rad", o.mean, {.doc = "mean of the prescribed angle"});
  v.key("rate_rad_s", o.rate, {.doc = "steady part of the prescribed angular velocity"});
  v.key("amplitude_rad", o.amplitude, {.doc = "amplitude of the prescribed oscillation"});
  keys::harmonic(v, o);
}

template <class V>
void declare(V& v, MountOptions& o) {
  v.key("point_m", o.point_m, {.doc = "the point of the body that is held, from the centre of gravity, in body axes"});
  v.section("x", o.x, "Displacement of the point along the inertial x axis.");
  v.section("y", o.y, "Displacement of the point along the inertial y axis.");
  v.section("z", o.z, "Displacement of the point along the inertial z axis.");
  v.section("rotation_x", o.rotation_x, "Rotation about the body's x axis, the innermost.");
  v.section("rotation_y", o.rotation_y, "Rotation about the inertial y axis, the outermost.");
  v.section("rotation_z", o.rotation_z, "Rotation about the z axis between them.");
}

template <class V>
void declare(V& v, VehicleOptions& o) {
  v.key("mass_kg", o.mass_kg, {.doc = "mass with rotors", .above = 0});
  v.key("inertia_kg_m2", o.inertia_kg_m2,
        {.doc = "moments of inertia about the body axes, with the rotors standing still"});
  v.key("inertia_products_kg_m2", o.inertia_products_kg_m2, {.doc = "products of inertia ∫xy dm, ∫xz dm, ∫yz dm"});
  v.key("gravity_m_s2", o.gravity_m_s2, {.doc = "gravity in inertial axes"});
  v.key("position_m", o.position_m,
        {.doc = "position at t = 0 of the mount's point (by default the centre of gravity)"});
  v.key("velocity_m_s", o.velocity_m_s, {.doc = "velocity of that point at t = 0, inertial axes"});
  v.key("rotation_rad", o.rotation_rad,
        {.doc = "attitude at t = 0: right-handed rotations about x (last), y (first), z (second)"});
  v.key("rotation_rate_rad_s", o.rotation_rate_rad_s, {.doc = "rates of these rotations at t = 0"});
  v.section("mount", o.mount, "What holds the body.");
  v.tables("rotor", o.rotor, "The rotors.");
}

template <class V>
void declare(V& v, IntegratorOptions& o) {
  v.key("method", o.method, {.doc = "linear multistep method of CVODE", .choices = {"adams", "bdf"}});
  v.key("relative_tolerance", o.relative_tolerance, {.doc = "relative error of a step", .above = 0, .max = 1e-3});
  v.key("absolute_tolerance", o.absolute_tolerance, {.doc = "absolute error of a step, SI units", .above = 0});
  v.key("max_steps", o.max_steps, {.doc = "CVODE's steps in one step of the flow, at most", .min = 1});
}

}  // namespace windhover::body
