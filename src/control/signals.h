// What goes into a controller and what comes out. W: inertial axes, B: body axes (x forward, y up, z right).
#pragma once
#include <Eigen/Core>
#include <vector>

namespace windhover::control {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

struct Measurement {
  Vec3 p_WoG_W = Vec3::Zero(), v_WG_W = Vec3::Zero();  ///< centre of gravity
  Mat3 R_WB = Mat3::Identity();
  Vec3 omega_WB_B = Vec3::Zero();
};

struct Setpoint {
  Vec3 p_W = Vec3::Zero();
  double yaw = 0;  ///< rad, right-handed about y
  Vec3 v_W = Vec3::Zero();
};

/// Commanded speed of each rotor (rad/s), positive in the rotor's own sense.
struct Command {
  std::vector<double> rotor_speed;
};

}  // namespace windhover::control
