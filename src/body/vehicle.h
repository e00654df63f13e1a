// The vehicle as an immutable model: validated, complete, SI units.
#pragma once
#include <limits>
#include <string>
#include <vector>

#include "body/motor.h"
#include "body/mount.h"
#include "body/vehicle_options.h"

namespace windhover::body {

struct Rotor {
  std::string name;
  double inertia;       ///< about the spin axis
  Vec3 spin_axis_B;     ///< unit vector, right-handed
  double speed, angle;  ///< at t = 0
  Motor motor;
  double off_at = std::numeric_limits<double>::infinity();
  Motor off = {};  ///< in its place from then on

  const Motor& motor_at(double t) const { return t < off_at ? motor : off; }
};

struct Vehicle {
  double mass;
  Mat3 inertia_BG_B;  ///< about the centre of gravity, rotors included as if they stood still
  Vec3 gravity_W;
  Vec3 p_GP_B;  ///< from the centre of gravity to the mount's point
  Mount mount;
  std::vector<Rotor> rotors;
};

/// Throws UserError for what cannot be; `prefix` is where the keys are, such as "body.".
Vehicle build_vehicle(const VehicleOptions& options, const std::string& prefix = "body.");

}  // namespace windhover::body
