#include "control/plan.h"

#include <algorithm>
#include <numbers>

#include "base/errors.h"

namespace windhover::control {

Plan::Plan(const std::vector<WaypointOptions>& waypoints, const std::string& prefix) {
  for (const WaypointOptions& waypoint : waypoints) {
    if (!times_.empty() && waypoint.time_s <= times_.back())
      throw UserError("{}plan[{}].time_s: is {}, must be later than the {} before it", prefix, times_.size(),
                      waypoint.time_s, times_.back());
    times_.push_back(waypoint.time_s);
    setpoints_.push_back({waypoint.position_m, -waypoint.yaw_deg * std::numbers::pi / 180, waypoint.velocity_m_s});
  }
  if (setpoints_.empty()) {
    times_.push_back(0);
    setpoints_.emplace_back();
  }
}

Setpoint Plan::at(double t) const {
  const auto next = std::upper_bound(times_.begin(), times_.end(), t) - times_.begin();
  return setpoints_[std::max<std::ptrdiff_t>(next - 1, 0)];
}

double Plan::next_change(double t) const {
  const auto next = std::upper_bound(times_.begin() + 1, times_.end(), t);
  return next == times_.end() ? std::numeric_limits<double>::infinity() : *next;
}

}  // namespace windhover::control
