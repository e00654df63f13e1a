#include "control/mixer.h"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/errors.h"

namespace windhover::control {
namespace {

using Eigen::Vector4d;
using Eigen::VectorXd;

constexpr const char* kAxes[] = {"thrust along y", "roll, a torque about x,", "yaw, a torque about y,",
                                 "pitch, a torque about z,"};

void check(const RotorModel& rotor, const std::string& prefix) {
  if (!(rotor.thrust_N_s2 > 0))
    throw UserError("{}thrust_N_s2: is {} for rotor \"{}\", must be > 0", prefix, rotor.thrust_N_s2, rotor.name);
  if (!(rotor.min_speed_rad_s >= 0 && rotor.min_speed_rad_s < rotor.max_speed_rad_s))
    throw UserError("{}max_speed_rad_s: rotor \"{}\" needs 0 <= min_speed_rad_s < max_speed_rad_s", prefix, rotor.name);
}

/// Force and torque per thrust; the air's torque on the rotor reaches the airframe against its spin.
Vector4d effect_of(const RotorModel& rotor) {
  const Vec3 axis = rotor.thrust_axis_B.normalized();
  const Vec3 torque = rotor.p_GR_B.cross(axis) - rotor.spin * rotor.torque_Nm_s2 / rotor.thrust_N_s2 * axis;
  return {axis.y(), torque.x(), torque.y(), torque.z()};
}

/// The largest part (0 to 1) of `change` that keeps `base` + part · change within the limits.
double admissible(const VectorXd& base, const VectorXd& change, const VectorXd& min, const VectorXd& max) {
  double part = 1;
  for (Eigen::Index j = 0; j < base.size(); ++j) {
    const double room = (change[j] > 0 ? max[j] : min[j]) - base[j];
    if (std::abs(change[j]) > std::abs(room)) part = std::min(part, room / change[j]);
  }
  return std::max(part, 0.0);
}

}  // namespace

Mixer::Mixer(const std::vector<RotorModel>& rotors, double torque_reserve, const std::string& prefix)
    : rotors_(rotors), effect_(4, rotors.size()), min_(rotors.size()), max_(rotors.size()) {
  for (std::size_t j = 0; j < rotors.size(); ++j) {
    check(rotors[j], prefix);
    effect_.col(j) = effect_of(rotors[j]);
    min_[j] = rotors[j].thrust(rotors[j].min_speed_rad_s);
    max_[j] = rotors[j].thrust(rotors[j].max_speed_rad_s);
  }
  inverse_ = effect_.completeOrthogonalDecomposition().pseudoInverse();
  const Eigen::Matrix4d reached = effect_ * inverse_;
  for (int axis = 0; axis < 4; ++axis)
    if ((reached.col(axis) - Vector4d::Unit(axis)).norm() > 1e-9)
      throw UserError("{}: the mixer cannot produce {} by itself: check positions, thrust axes, spins and torques",
                      prefix, kAxes[axis]);

  double lowest = 0, highest = std::numeric_limits<double>::infinity();
  for (Eigen::Index j = 0; j < max_.size(); ++j) {
    const double share = inverse_(j, 0);
    if (std::abs(share) < 1e-12) continue;  // a rotor that only turns the vehicle
    lowest = std::max(lowest, min_[j] / share);
    highest = std::min(highest, max_[j] / share);  // below 0 when this rotor would have to push down
  }
  if (!(lowest < highest)) throw UserError("{}: no collective thrust keeps every rotor within its speeds", prefix);
  min_collective_ = lowest + torque_reserve * (highest - lowest);
  max_collective_ = highest - torque_reserve * (highest - lowest);
}

Wrench Mixer::produced(const VectorXd& thrust) const {
  const Vector4d wrench = effect_ * thrust;
  return {wrench[0], wrench.tail<3>()};
}

Allocation Mixer::allocate(const Wrench& demand) const {
  VectorXd thrust = inverse_.col(0) * std::clamp(demand.thrust, min_collective_, max_collective_);
  const VectorXd roll_pitch = inverse_.col(1) * demand.torque_B.x() + inverse_.col(3) * demand.torque_B.z();
  const VectorXd yaw = inverse_.col(2) * demand.torque_B.y();
  for (const VectorXd& change : {roll_pitch, yaw}) thrust += admissible(thrust, change, min_, max_) * change;
  thrust = thrust.cwiseMax(min_).cwiseMin(max_);
  return {thrust, produced(thrust)};
}

Command Mixer::speeds(const VectorXd& thrust) const {
  Command command;
  for (std::size_t j = 0; j < rotors_.size(); ++j)
    command.rotor_speed.push_back(std::sqrt(thrust[j] / rotors_[j].thrust_N_s2));
  return command;
}

}  // namespace windhover::control
