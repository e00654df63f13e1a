#include "app/held_flight.h"

#include <algorithm>

#include "base/errors.h"

namespace windhover::app {
namespace {

using body::Vec6;
using coupling::Hold;
using coupling::VectorXd;
using coupling::VehicleState;

/// Part of the way after part x of the time, its rate and its integral: without a jump of velocity or acceleration.
struct Ramp {
  double part = 1, rate = 0, integral = 0;
};
Ramp ramp(double x) {
  if (x >= 1) return {1, 0, x - 0.5};
  return {x * x * x * (10 + x * (6 * x - 15)), 30 * x * x * (1 - x) * (1 - x), x * x * x * x * (2.5 + x * (x - 3))};
}

}  // namespace

HeldFlight::HeldFlight(const Case& c, fluid::FlowSolver& solver, const ZoneTree& zones)
    : solver_(solver),
      scale_s_(Scales(c.fluid).time()),
      flight_(c, solver, zones),
      equilibrium_(flight_.window(), c.trim, c.fluid.length_m) {
  const auto& rotors = flight_.window().vehicle().vehicle().rotors;
  for (size_t j = 0; j < rotors.size(); ++j) {
    const auto& unknowns = equilibrium_.unknowns();
    if (std::find(unknowns.begin(), unknowns.end(), rotors[j].name) != unknowns.end() &&
        !flight_.has_walls(static_cast<int>(j)))
      throw UserError("trim.unknowns: no wall of the mesh turns with the rotor \"{}\": its speed changes no force",
                      rotors[j].name);
  }
}

void HeldFlight::start(const std::vector<double>& checkpoint) {
  if (checkpoint.empty())
    flight_.start();
  else
    flight_.start_from(checkpoint);
  const VehicleState& vehicle = flight_.vehicle();
  angle_.resize(flight_.window().vehicle().rotors());
  for (Eigen::Index j = 0; j < angle_.size(); ++j)
    angle_[j] = flight_.window().rotor_angle(vehicle, static_cast<int>(j));
  from_ = to_ = equilibrium_.hold(vehicle);
  left_s_ = time();
}

HeldFlight::Moment HeldFlight::moment(double t) const {
  const double since = t - left_s_;
  const Ramp r = duration_s_ > 0 ? ramp(since / duration_s_) : Ramp{1, 0, since};
  const double unit = duration_s_ > 0 ? duration_s_ : 1;
  const Vec6 way = to_.coordinates - from_.coordinates;
  const VectorXd more = to_.rotor_speed - from_.rotor_speed;
  return {{from_.coordinates + r.part * way, from_.rotor_speed + r.part * more},
          r.rate / unit * way,
          angle_ + since * from_.rotor_speed + unit * r.integral * more};
}

void HeldFlight::move_to(const Hold& hold, double duration_s) {
  const Moment now = moment(time());
  from_ = now.hold;
  angle_ = now.angle;
  to_ = hold;
  left_s_ = time();
  duration_s_ = duration_s;
}

VehicleState HeldFlight::vehicle(double t) const {
  const Moment now = moment(t);
  return equilibrium_.state(t, now.hold, now.rates, now.angle, t);
}

Mover::Result HeldFlight::advance(double dt) {
  return {solver_.advance([this](double t) { return flight_.frames(vehicle(t * scale_s_)); }, dt), 0};
}

VehicleState HeldFlight::at_rest() {
  const Moment now = moment(time());
  const VehicleState rest = equilibrium_.state(time(), now.hold, Vec6::Zero(), now.angle, 0);
  return flight_.window().settled(rest, air().loads);
}

std::vector<double> HeldFlight::state() {
  flight_.start(at_rest());
  return flight_.state();
}

HeldFlight::Control HeldFlight::control() {
  const VehicleState rest = at_rest();
  const auto answer = flight_.window().control(rest);
  Control control;
  const int rotors = flight_.window().vehicle().rotors();
  const std::vector<double> holding = flight_.window().holding(rest, air().loads).rotor_speed;
  for (int j = 0; j < rotors; ++j) {
    const double error = std::abs(answer.command.rotor_speed[j] - holding[j]) / std::max(std::abs(holding[j]), 1e-12);
    control.speed_error = std::max(control.speed_error, error);
  }
  for (const double rate : answer.rate) control.state_rate = std::max(control.state_rate, std::abs(rate));
  return control;
}

}  // namespace windhover::app
