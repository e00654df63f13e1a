// Where to be and when: setpoints that hold from their time on.
#pragma once
#include <limits>
#include <string>
#include <vector>

#include "control/control_options.h"
#include "control/signals.h"

namespace windhover::control {

class Plan {
 public:
  /// UserError unless the times increase; without waypoints the setpoint is the origin.
  explicit Plan(const std::vector<WaypointOptions>& waypoints, const std::string& prefix = "controller.");

  /// Before the first waypoint: the first.
  Setpoint at(double t) const;

  /// The first time after t at which the setpoint jumps; infinite when there is none.
  double next_change(double t) const;

 private:
  std::vector<double> times_;
  std::vector<Setpoint> setpoints_;
};

}  // namespace windhover::control
