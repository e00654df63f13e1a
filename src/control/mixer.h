// From a demanded thrust and torque to the thrust of each rotor, for any layout of rotors.
#pragma once
#include <string>

#include "control/airframe.h"

namespace windhover::control {

/// Force along body y (N) and torque about the centre of gravity in body axes (N m).
struct Wrench {
  double thrust = 0;
  Vec3 torque_B = Vec3::Zero();
};

struct Allocation {
  Eigen::VectorXd thrust;  ///< of each rotor (N), within its limits
  Wrench achieved;
};

/// The least-squares inverse of what the rotors produce by their places, axes and spins. Under saturation collective
/// thrust comes first, short of a reserve at either end of its range, then roll and pitch, then yaw.
class Mixer {
 public:
  /// UserError when the rotors cannot produce thrust or torque about some axis.
  Mixer(const std::vector<RotorModel>& rotors, double torque_reserve, const std::string& prefix);

  Allocation allocate(const Wrench& demand) const;
  Wrench produced(const Eigen::VectorXd& thrust) const;
  Command speeds(const Eigen::VectorXd& thrust) const;

 private:
  std::vector<RotorModel> rotors_;
  Eigen::Matrix<double, 4, Eigen::Dynamic> effect_;   ///< wrench per thrust of each rotor
  Eigen::Matrix<double, Eigen::Dynamic, 4> inverse_;  ///< thrust of each rotor per wrench
  Eigen::VectorXd min_, max_;
  double min_collective_, max_collective_;
};

}  // namespace windhover::control
