// A quadcopter with a simple air: thrust CT ρ n² D⁴, torque CP ρ n² D⁵ / 2π, drag of the airframe. Rotors by place.
#pragma once
#include <catch2/catch.hpp>
#include <functional>
#include <numbers>

#include "body/integrator.h"
#include "body/vehicle_ode.h"
#include "control/controllers.h"
#include "control/plan.h"
#include "control/sampler.h"

namespace windhover::control {

constexpr double kPi = std::numbers::pi;
constexpr double kDensity = 1.2, kDiameter = 0.2667, kGravity = 9.80665;

inline RotorModel rotor_model(const std::string& name, double x, double z, double spin) {
  const double per_square = kDensity * std::pow(kDiameter, 4) / (4 * kPi * kPi);
  return {.name = name,
          .p_GR_B = Vec3(x, 0.03, z),
          .spin = spin,
          .thrust_N_s2 = 0.11 * per_square,
          .torque_Nm_s2 = 0.045 / (2 * kPi) * kDiameter * per_square,
          .min_speed_rad_s = 50,
          .max_speed_rad_s = 900};
}

inline Airframe quadcopter() {
  Airframe a{.mass = 1.72, .inertia_BG_B = Vec3(0.0175, 0.025, 0.0175).asDiagonal(), .gravity = kGravity, .rotors = {}};
  a.inertia_BG_B(0, 1) = a.inertia_BG_B(1, 0) = -0.0004;
  a.rotors = {rotor_model("front_right", 0.16, 0.18, 1), rotor_model("front_left", 0.16, -0.18, -1),
              rotor_model("rear_left", -0.16, -0.18, 1), rotor_model("rear_right", -0.16, 0.18, -1)};
  return a;
}

inline double hover_speed(const Airframe& a) { return std::sqrt(a.mass * kGravity / 4 / a.rotors[0].thrust_N_s2); }

/// The vehicle, the air and the controller as one problem. Continuous (rate 0) or sampled.
class ClosedLoop {
 public:
  ClosedLoop(const Airframe& airframe, const ControllerOptions& options)
      : airframe_(airframe),
        options_(options),
        vehicle_(body::build_vehicle(vehicle_options())),
        controller_(make_controller(options, airframe)),
        plan_(options.plan),
        sampler_(*controller_, options.rate_hz),
        sampled(sampler_.start()),
        y(vehicle_.initial_state()) {
    if (!is_sampled()) y.resize(y.size() + controller_->state_size());
  }

  bool is_sampled() const { return options_.rate_hz > 0; }

  Measurement measure(double t, std::span<const double> state) const {
    const body::Kinematics k = vehicle_.kinematics(t, state);
    return {k.p_WoG_W, k.v_WG_W, k.R_WB, k.omega_WB_B};
  }
  Measurement measure() const { return measure(time, y); }
  double rotor_speed(int j) const { return y[vehicle_.rotor_speed_offset() + j]; }

  /// Segments end where the setpoint jumps and where samples are taken.
  void advance(double end, const std::function<void(double t)>& at_sample = {}) {
    while (time < end) {
      if (is_sampled() && sampler_.next_time(sampled) <= time) {
        sampler_.sample(measure(), plan_.at(time), sampled);
        if (at_sample) at_sample(time);
      }
      double stop = std::min(end, plan_.next_change(time));
      if (is_sampled()) stop = std::min(stop, sampler_.next_time(sampled));
      integrator_.advance(problem(plan_.at(time)), time, stop, y);
      time = stop;
    }
  }

  Vec3 wind_W = Vec3::Zero();
  double drag_area = 0;

 private:
  body::VehicleOptions vehicle_options() const {
    body::VehicleOptions o;
    o.mass_kg = airframe_.mass;
    o.inertia_kg_m2 = airframe_.inertia_BG_B.diagonal();
    o.inertia_products_kg_m2 = Vec3(-airframe_.inertia_BG_B(0, 1), 0, 0);
    for (const RotorModel& r : airframe_.rotors)
      o.rotor.push_back({.name = r.name,
                         .inertia_kg_m2 = 5e-5,
                         .spin_axis = r.spin * r.thrust_axis_B,
                         .speed_rad_s = hover_speed(airframe_),
                         .motor = {.kind = "servo", .time_constant_s = 0.03}});
    return o;
  }

  std::vector<double> loads(const body::Kinematics& k, const double* speeds) const {
    std::vector<double> loads(body::LoadLayout::size(vehicle_.rotors()));
    const Vec3 relative = k.v_WG_W - wind_W;
    Vec3 force = -0.5 * kDensity * drag_area * relative.norm() * relative, torque_B = Vec3::Zero();
    for (int j = 0; j < vehicle_.rotors(); ++j) {
      const RotorModel& r = airframe_.rotors[j];
      const Vec3 thrust_B = r.thrust(speeds[j]) * r.thrust_axis_B;
      const double torque = r.torque_Nm_s2 * speeds[j] * speeds[j];
      force += k.R_WB * thrust_B;
      torque_B += r.p_GR_B.cross(thrust_B) - r.spin * torque * r.thrust_axis_B;
      loads[body::LoadLayout::rotor + j] = -torque;
    }
    Vec3::Map(&loads[body::LoadLayout::force]) = force;
    Vec3::Map(&loads[body::LoadLayout::torque]) = k.R_WB * torque_B;
    return loads;
  }

  body::Ode problem(const Setpoint& setpoint) const {
    return {
        .derivative =
            [this, setpoint](double t, std::span<const double> state, std::span<double> rate) {
              const int n = vehicle_.size();
              const Command command =
                  is_sampled() ? sampled.held
                               : controller_->evaluate(measure(t, state), setpoint, state.subspan(n), rate.subspan(n));
              const body::Kinematics k = vehicle_.kinematics(t, state);
              vehicle_.derivative(t, state, loads(k, &state[vehicle_.rotor_speed_offset()]), command.rotor_speed, rate);
            },
        .project = [this](std::span<double> state) { vehicle_.project(state); }};
  }

  Airframe airframe_;
  ControllerOptions options_;
  body::VehicleOde vehicle_;
  std::unique_ptr<Controller> controller_;
  Plan plan_;
  Sampler sampler_;
  body::Integrator integrator_{{.method = "bdf", .relative_tolerance = 1e-7, .absolute_tolerance = 1e-9}};

 public:
  double time = 0;
  SampledState sampled;
  std::vector<double> y;
};

}  // namespace windhover::control
