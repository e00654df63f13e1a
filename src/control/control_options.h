// What a user says about the controller. Vectors of gains belong to x, y, z; those of the body to roll, yaw, pitch.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "control/signals.h"

namespace windhover::control {

struct CascadeOptions {
  Vec3 position_gain_1_s = Vec3(1, 1.5, 1);
  double max_speed_m_s = 5;
  Vec3 velocity_gain_1_s = Vec3(2, 3, 2);
  Vec3 velocity_integral_1_s2 = Vec3(0.5, 1, 0.5);
  double max_tilt_deg = 45;
  Vec3 attitude_gain_1_s = Vec3(6.5, 2.8, 6.5);
  Vec3 max_rate_deg_s = Vec3(220, 100, 220);
  Vec3 rate_gain_1_s = Vec3(20, 8, 20);
  Vec3 rate_integral_1_s2 = Vec3(20, 4, 20);
  Vec3 rate_derivative = Vec3::Zero();
  double rate_filter_s = 0.005;
  double antiwindup_s = 0.2;
  double torque_reserve = 0.1;
};

struct WaypointOptions {
  double time_s = 0;
  Vec3 position_m = Vec3::Zero();
  double yaw_deg = 0;  ///< clockwise seen from above
  Vec3 velocity_m_s = Vec3::Zero();
};

struct ControllerOptions {
  std::string kind = "none";
  double rate_hz = 0;
  std::map<std::string, double> speed_rad_s;
  CascadeOptions cascade;
  std::vector<WaypointOptions> plan;
};

}  // namespace windhover::control
