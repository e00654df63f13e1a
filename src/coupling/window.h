// Vehicle, motors and controller over one window of time as a pure function: state and loads in, state out.
#pragma once
#include <memory>

#include "body/integrator.h"
#include "body/vehicle_ode.h"
#include "control/controllers.h"
#include "control/plan.h"
#include "control/sampler.h"

namespace windhover::coupling {

/// All that the vehicle's future depends on besides the loads. Keeping a copy is saving, using it again restoring.
struct VehicleState {
  double t = 0;           ///< s
  std::vector<double> y;  ///< body, mount, rotors (VehicleOde), then the states of a continuous controller
  control::SampledState sampled;
};

struct VehicleModel {
  body::VehicleOptions vehicle;
  body::IntegratorOptions integrator;
  control::ControllerOptions controller;
  std::vector<control::RotorModel> rotors;  ///< what the controller knows of them, in the vehicle's order
};

/// Times this close, relative to themselves, are one.
constexpr double kSameTime = 1e-12;

class Window {
 public:
  /// UserError for what cannot be: keys of the vehicle are named under "body.", those of the controller "controller.".
  explicit Window(const VehicleModel& model);

  const body::VehicleOde& vehicle() const { return vehicle_; }
  int interface_size() const { return body::LoadLayout::size(vehicle_.rotors()); }
  /// Motions that answer to the loads: the mount's and those of rotors on torque-driven motors.
  int responding_motions() const;

  /// Which loads (LoadLayout) change how this state goes on: not those on locked axes, nor the torques on servo motors.
  using Responses = Eigen::Array<bool, Eigen::Dynamic, 1>;
  Responses responding_loads(const VehicleState& s) const;

  VehicleState start() const;
  body::Kinematics kinematics(const VehicleState& s) const { return vehicle_.kinematics(s.t, s.y); }
  double rotor_speed(const VehicleState& s, int j) const { return s.y[vehicle_.rotor_speed_offset() + j]; }
  double rotor_angle(const VehicleState& s, int j) const { return s.y[vehicle_.rotor_angle_offset() + j]; }

  /// The state at `end`. CVODE stops at samples and where the setpoint jumps. SolverFailure when CVODE gives up.
  VehicleState advance(const VehicleState& start, const body::LoadPolynomial& loads, double end) const;

  /// The first time after s at which the setpoint jumps or the controller takes a sample; infinite when there is none.
  double next_event(const VehicleState& s) const;

  /// The commands that keep the rotors' speeds against the air (loads: LoadLayout), as far as their motors can.
  control::Command holding(const VehicleState& s, const Eigen::VectorXd& loads) const;
  /// The same vehicle, its controller in the states with which it gives these commands at the setpoint of t = 0, as far
  /// as it can.
  VehicleState settled(const VehicleState& s, const Eigen::VectorXd& loads) const;
  /// What the controller does with its states at the setpoint of t = 0.
  struct Control {
    control::Command command;
    std::vector<double> rate;  ///< of its states
  };
  Control control(const VehicleState& s) const;

  /// How far apart two outcomes of one window are, relative to the motion over it: the largest of position, attitude and
  /// rotor angles. Motions below a millionth of `length` (m), or of a radian, count as that much.
  double pose_difference(const VehicleState& start, const VehicleState& a, const VehicleState& b, double length) const;

 private:
  double next_motor_off(double t) const;
  bool is_sampled() const { return sampler_rate_ > 0; }
  control::Measurement measure(double t, std::span<const double> y) const;
  body::Ode problem(const control::Setpoint& setpoint, const body::LoadPolynomial& loads,
                    const control::SampledState& sampled) const;

  body::VehicleOde vehicle_;
  std::unique_ptr<control::Controller> controller_;
  control::Plan plan_;
  double sampler_rate_;  ///< Hz; 0: continuous
  control::Sampler sampler_;
  body::Integrator integrator_;
};

}  // namespace windhover::coupling
