// Vehicles without air for the tests of the body.
#pragma once
#include <catch2/catch.hpp>
#include <numbers>

#include "body/integrator.h"
#include "body/vehicle_ode.h"

namespace windhover::body {

constexpr double kPi = std::numbers::pi;
constexpr const char* kMethods[] = {"adams", "bdf"};

inline IntegratorOptions tight(const std::string& method = "adams") {
  return {.method = method, .relative_tolerance = 1e-12, .absolute_tolerance = 1e-14, .max_steps = 1000000};
}

inline VehicleOptions brick() {
  VehicleOptions o;
  o.mass_kg = 1.7;
  o.inertia_kg_m2 = Vec3(0.018, 0.031, 0.024);
  o.gravity_m_s2.setZero();
  return o;
}

inline void lock_all(MountOptions& m) {
  for (TranslationOptions* freedom : {&m.x, &m.y, &m.z}) freedom->kind = "locked";
  for (RotationOptions* freedom : {&m.rotation_x, &m.rotation_y, &m.rotation_z}) freedom->kind = "locked";
}

inline RotorOptions rotor(const std::string& name, const Vec3& axis, double inertia, const std::string& motor) {
  RotorOptions r{.name = name, .inertia_kg_m2 = inertia, .spin_axis = axis, .motor = {.kind = motor}};
  r.motor.torque_constant_Nm_A = 0.01;
  r.motor.resistance_ohm = 0.1;
  r.motor.supply_V = 12;
  return r;
}

inline LoadPolynomial no_loads(const VehicleOde& vehicle) {
  return LoadPolynomial({{0, Eigen::VectorXd::Zero(LoadLayout::size(vehicle.rotors()))}});
}

/// Kinetic energy and angular momentum about the centre of gravity, inertial axes, with the rotors' own.
struct Invariants {
  double energy;
  Vec3 momentum_W;
};

inline Invariants invariants(const VehicleOde& ode, double t, const std::vector<double>& y) {
  const Kinematics k = ode.kinematics(t, y);
  const Vehicle& v = ode.vehicle();
  Vec3 momentum = v.inertia_BG_B * k.omega_WB_B;
  double energy = 0.5 * k.omega_WB_B.dot(momentum) + 0.5 * v.mass * k.v_WG_W.squaredNorm();
  for (int j = 0; j < ode.rotors(); ++j) {
    const Rotor& r = v.rotors[j];
    const double speed = y[ode.rotor_speed_offset() + j];
    momentum += r.inertia * speed * r.spin_axis_B;
    energy += r.inertia * speed * (0.5 * speed + r.spin_axis_B.dot(k.omega_WB_B));
  }
  return {energy, k.R_WB * momentum};
}

/// Without loads, with constant commands (one per rotor).
inline void fly(const VehicleOde& ode, double t0, double t1, std::vector<double>& y, const IntegratorOptions& options,
                const std::vector<double>& command = {}) {
  const LoadPolynomial loads = no_loads(ode);
  Integrator(options).advance(vehicle_ode(ode, loads, command), t0, t1, y);
}

}  // namespace windhover::body
