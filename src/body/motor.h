// Motors: pure functions of the commanded and the actual rotor speed (rad/s, about the rotor's spin axis).
#pragma once
#include <algorithm>
#include <cmath>
#include <variant>

namespace windhover::body {

/// Follows the commanded speed with a first-order lag, whatever the load.
struct ServoMotor {
  double time_constant;  ///< s

  double acceleration(double command, double speed) const { return (command - speed) / time_constant; }

  /// The command that keeps a speed against the air's torque (N m, negative: it brakes).
  double holding(double speed, double) const { return speed; }
};

/// A direct-current motor without inductance: loads slow it down. The command sets its voltage: that of the commanded
/// speed without load.
struct TorqueMotor {
  double torque_constant;   ///< N m/A, which is V s/rad
  double resistance;        ///< ohm
  double supply;            ///< V
  double friction;          ///< N m, constant, against the rotation
  double viscous_friction;  ///< N m s
  double governor;          ///< V s: further volts per rad/s of missing speed (0: no speed control)

  /// Torque on the rotor (N m).
  double torque(double command, double speed) const {
    const double voltage = std::clamp(torque_constant * command + governor * (command - speed), 0.0, supply);
    const double current = (voltage - torque_constant * speed) / resistance;
    return torque_constant * current - losses(speed);
  }

  /// The command that keeps a speed against the air's torque (N m, negative: it brakes), as far as the supply goes.
  double holding(double speed, double air_torque) const {
    const double current = (losses(speed) - air_torque) / torque_constant;
    const double voltage = std::clamp(resistance * current + torque_constant * speed, 0.0, supply);
    return (voltage + governor * speed) / (torque_constant + governor);
  }

 private:
  double losses(double speed) const {
    constexpr double kSlow = 1;  // rad/s: constant friction fades below, so that a rotor can stand still
    return friction * std::tanh(speed / kSlow) + viscous_friction * speed;
  }
};

using Motor = std::variant<ServoMotor, TorqueMotor>;

/// A motor without current: only its losses brake the rotor.
inline TorqueMotor without_current(double friction, double viscous_friction) {
  return {.torque_constant = 0,
          .resistance = 1,
          .supply = 0,
          .friction = friction,
          .viscous_friction = viscous_friction,
          .governor = 0};
}

}  // namespace windhover::body
