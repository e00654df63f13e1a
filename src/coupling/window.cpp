#include "coupling/window.h"

#include <algorithm>
#include <cmath>

namespace windhover::coupling {
namespace {

using body::Vec3;

control::Airframe airframe(const body::Vehicle& vehicle, const std::vector<control::RotorModel>& rotors) {
  return {.mass = vehicle.mass,
          .inertia_BG_B = vehicle.inertia_BG_B,
          .gravity = vehicle.gravity_W.norm(),
          .rotors = rotors};
}

constexpr double kLeastMotion = 1e-6;

}  // namespace

Window::Window(const VehicleModel& model)
    : vehicle_(body::build_vehicle(model.vehicle)),
      controller_(control::make_controller(model.controller, airframe(vehicle_.vehicle(), model.rotors))),
      plan_(model.controller.plan),
      sampler_rate_(model.controller.rate_hz),
      sampler_(*controller_, sampler_rate_),
      integrator_(model.integrator) {}

int Window::responding_motions() const {
  const body::Vehicle& v = vehicle_.vehicle();
  return v.mount.speed_size() + static_cast<int>(std::count_if(v.rotors.begin(), v.rotors.end(), [](const auto& rotor) {
           return std::holds_alternative<body::TorqueMotor>(rotor.motor) || std::isfinite(rotor.off_at);
         }));
}

Window::Responses Window::responding_loads(const VehicleState& s) const {
  const std::vector<double> commands(vehicle_.rotors());
  const auto rates = [&](const Eigen::VectorXd& loads) {
    std::vector<double> rate(vehicle_.size());
    const std::span<const double> values(loads.data(), static_cast<size_t>(loads.size()));
    vehicle_.derivative(s.t, std::span(s.y).first(vehicle_.size()), values, commands, rate);
    return rate;
  };
  const auto free = rates(Eigen::VectorXd::Zero(interface_size()));
  Responses responds(interface_size());
  for (int i = 0; i < interface_size(); ++i) responds[i] = rates(Eigen::VectorXd::Unit(interface_size(), i)) != free;
  return responds;
}

VehicleState Window::start() const {
  VehicleState s{.t = 0, .y = vehicle_.initial_state(), .sampled = sampler_.start()};
  if (!is_sampled()) s.y.resize(s.y.size() + controller_->state_size());
  return s;
}

control::Measurement Window::measure(double t, std::span<const double> y) const {
  const body::Kinematics k = vehicle_.kinematics(t, y);
  return {k.p_WoG_W, k.v_WG_W, k.R_WB, k.omega_WB_B};
}

control::Command Window::holding(const VehicleState& s, const Eigen::VectorXd& loads) const {
  control::Command command;
  for (int j = 0; j < vehicle_.rotors(); ++j)
    command.rotor_speed.push_back(std::visit(
        [&](const auto& motor) { return motor.holding(rotor_speed(s, j), loads[body::LoadLayout::rotor + j]); },
        vehicle_.vehicle().rotors[j].motor_at(s.t)));
  return command;
}

VehicleState Window::settled(const VehicleState& s, const Eigen::VectorXd& loads) const {
  VehicleState settled = s;
  const std::vector<double> state = controller_->state_for(measure(s.t, s.y), plan_.at(0), holding(s, loads));
  if (is_sampled())
    settled.sampled.state = state;
  else
    std::copy(state.begin(), state.end(), settled.y.begin() + vehicle_.size());
  return settled;
}

Window::Control Window::control(const VehicleState& s) const {
  const std::span<const double> state =
      is_sampled() ? std::span(s.sampled.state) : std::span(s.y).subspan(vehicle_.size());
  Control control{{}, std::vector<double>(state.size())};
  control.command = controller_->evaluate(measure(s.t, s.y), plan_.at(0), state, control.rate);
  return control;
}

body::Ode Window::problem(const control::Setpoint& setpoint, const body::LoadPolynomial& loads,
                          const control::SampledState& sampled) const {
  return {.derivative =
              [&, setpoint, values = std::vector<double>(loads.size())](double t, std::span<const double> y,
                                                                        std::span<double> rate) mutable {
                const int n = vehicle_.size();
                loads.evaluate(t, values);
                const control::Command command =
                    is_sampled() ? sampled.held
                                 : controller_->evaluate(measure(t, y), setpoint, y.subspan(n), rate.subspan(n));
                vehicle_.derivative(t, y, values, command.rotor_speed, rate);
              },
          .project = [this](std::span<double> y) { vehicle_.project(y); }};
}

double Window::next_motor_off(double t) const {
  double next = std::numeric_limits<double>::infinity();
  for (const auto& rotor : vehicle_.vehicle().rotors)
    if (rotor.off_at > t) next = std::min(next, rotor.off_at);
  return next;
}

VehicleState Window::advance(const VehicleState& start, const body::LoadPolynomial& loads, double end) const {
  VehicleState s = start;
  while (s.t < end) {
    if (is_sampled() && sampler_.next_time(s.sampled) <= s.t)
      sampler_.sample(measure(s.t, s.y), plan_.at(s.t), s.sampled);
    double stop = std::min({end, plan_.next_change(s.t), next_motor_off(s.t)});
    if (is_sampled()) stop = std::min(stop, sampler_.next_time(s.sampled));
    integrator_.advance(problem(plan_.at(s.t), loads, s.sampled), s.t, stop, s.y);
    s.t = stop;
  }
  return s;
}

double Window::next_event(const VehicleState& s) const {
  const double after = s.t * (1 + kSameTime);
  double event = std::min(plan_.next_change(after), next_motor_off(after));
  if (is_sampled()) event = std::min(event, (std::floor(after * sampler_rate_) + 1) / sampler_rate_);
  return event;
}

double Window::pose_difference(const VehicleState& start, const VehicleState& a, const VehicleState& b,
                               double length) const {
  const body::Kinematics from = kinematics(start), to = kinematics(b), other = kinematics(a);
  const double dt = b.t - start.t;
  const auto relative = [&](double difference, double speed, double least) {
    return difference / std::max(speed * dt, kLeastMotion * least);
  };
  const Eigen::Quaterniond turn(body::Mat3(other.R_WB.transpose() * to.R_WB));
  double largest =
      relative((other.p_WoG_W - to.p_WoG_W).norm(), std::max(from.v_WG_W.norm(), to.v_WG_W.norm()), length);
  largest =
      std::max(largest, relative(2 * turn.vec().norm(), std::max(from.omega_WB_B.norm(), to.omega_WB_B.norm()), 1));
  for (int j = 0; j < vehicle_.rotors(); ++j)
    largest = std::max(largest, relative(std::abs(rotor_angle(a, j) - rotor_angle(b, j)),
                                         std::max(std::abs(rotor_speed(start, j)), std::abs(rotor_speed(b, j))), 1));
  return largest;
}

}  // namespace windhover::coupling
