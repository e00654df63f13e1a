// What a controller knows of the vehicle it flies.
#pragma once
#include <string>
#include <vector>

#include "control/signals.h"

namespace windhover::control {

struct RotorModel {
  std::string name;
  Vec3 p_GR_B = Vec3::Zero();  ///< hub, from the centre of gravity
  Vec3 thrust_axis_B = Vec3::UnitY();
  double spin =
      1;  ///< +1: turns right-handed about the thrust axis (counter-clockwise seen from above), -1: left-handed
  double thrust_N_s2 = 0;   ///< thrust over the square of the speed
  double torque_Nm_s2 = 0;  ///< torque of the air over the square of the speed
  double min_speed_rad_s = 0, max_speed_rad_s = 0;

  double thrust(double speed) const { return thrust_N_s2 * speed * speed; }
};

struct Airframe {
  double mass = 0;
  Mat3 inertia_BG_B = Mat3::Identity();
  double gravity = 9.80665;  ///< m/s², against y
  std::vector<RotorModel> rotors;
};

}  // namespace windhover::control
