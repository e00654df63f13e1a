#include "body/mount.h"

#include "base/errors.h"

namespace windhover::body {

Mount::Mount(const std::array<Freedom, 6>& freedoms) : freedoms_(freedoms) {
  for (int k = 0; k < 6; ++k) (k < 3 ? translations_ : rotations_) += freedoms_[k].is_state();
  gimbal_ = rotations_ < 3;
}

void Mount::initial(std::span<double> positions, std::span<double> speeds) const {
  Vec6 coordinates, rates;
  for (int k = 0; k < 6; ++k) coordinates[k] = freedoms_[k].initial, rates[k] = freedoms_[k].initial_rate;
  place(coordinates, rates, positions, speeds);
}

void Mount::place(const Vec6& coordinates, const Vec6& rates, std::span<double> positions,
                  std::span<double> speeds) const {
  int i = 0;
  for (int k = 0; k < (gimbal_ ? 6 : 3); ++k) {
    if (!freedoms_[k].is_state()) continue;
    positions[i] = coordinates[k];
    speeds[i++] = rates[k];
  }
  if (gimbal_) return;
  const Vec3 angles = coordinates.tail<3>();
  Vec4::Map(&positions[i]) = quaternion_of(gimbal_rotation(angles));
  Vec3::Map(&speeds[i]) = gimbal_axes(angles) * rates.tail<3>();
}

Vec6 Mount::coordinates(double t, std::span<const double> positions) const {
  Vec6 coordinates;
  int i = 0;
  for (int k = 0; k < 6; ++k) {
    if (!freedoms_[k].is_state())
      coordinates[k] = freedoms_[k].motion->value(t);
    else if (k < 3 || gimbal_)
      coordinates[k] = positions[i++];
  }
  if (!gimbal_) coordinates.tail<3>() = gimbal_angles(rotation_of(Vec4::Map(&positions[i])));
  return coordinates;
}

MountMotion Mount::evaluate(double t, std::span<const double> positions, std::span<const double> speeds) const {
  MountMotion m;
  m.map.setZero(6, speed_size());
  m.drift.setZero();
  m.force.setZero(speed_size());
  translate(t, positions, speeds, m);
  if (gimbal_)
    rotate_in_gimbal(t, positions, speeds, m);
  else
    rotate_freely(positions, speeds, m);
  return m;
}

void Mount::translate(double t, std::span<const double> positions, std::span<const double> speeds,
                      MountMotion& m) const {
  int i = 0;
  for (int k = 0; k < 3; ++k) {
    const Freedom& freedom = freedoms_[k];
    if (freedom.is_state()) {
      m.p_WoP_W[k] = positions[i];
      m.v_WP_W[k] = speeds[i];
      m.map(k, i) = 1;
      m.force[i] = freedom.force(positions[i], speeds[i]);
      ++i;
    } else {
      m.p_WoP_W[k] = freedom.motion->value(t);
      m.v_WP_W[k] = freedom.motion->derivative(t);
      m.drift[k] = freedom.motion->second_derivative(t);
    }
  }
}

void Mount::rotate_freely(std::span<const double> positions, std::span<const double> speeds, MountMotion& m) const {
  const int i = translations_;
  m.R_WB = rotation_of(Vec4::Map(&positions[i]));
  m.omega_WB_B = Vec3::Map(&speeds[i]);
  m.map.block<3, 3>(3, i).setIdentity();
  if (!freedoms_[3].sprung() && !freedoms_[4].sprung() && !freedoms_[5].sprung()) return;

  const Vec3 angles = gimbal_angles(m.R_WB);
  if (std::abs(std::cos(angles.z())) < 1e-6)
    throw SolverFailure("mount: gimbal lock, rotation_z of a body with springs on its rotations reached 90°");
  const Mat3 axes = gimbal_axes(angles);
  const Vec3 rates = axes.inverse() * m.omega_WB_B;
  Vec3 torque;  // about the gimbal's axes; its power is that of the torque in body axes
  for (int k = 0; k < 3; ++k) torque[k] = freedoms_[3 + k].force(angles[k], rates[k]);
  m.force.segment<3>(i) = axes.transpose().inverse() * torque;
}

void Mount::rotate_in_gimbal(double t, std::span<const double> positions, std::span<const double> speeds,
                             MountMotion& m) const {
  Vec3 angles, rates, accelerations = Vec3::Zero();
  int i = translations_;
  for (int k = 0; k < 3; ++k) {
    const Freedom& freedom = freedoms_[3 + k];
    if (freedom.is_state()) {
      angles[k] = positions[i];
      rates[k] = speeds[i];
      m.force[i] = freedom.force(positions[i], speeds[i]);
      ++i;
    } else {
      angles[k] = freedom.motion->value(t);
      rates[k] = freedom.motion->derivative(t);
      accelerations[k] = freedom.motion->second_derivative(t);
    }
  }
  const Mat3 axes = gimbal_axes(angles);
  m.R_WB = gimbal_rotation(angles);
  m.omega_WB_B = axes * rates;
  m.drift.tail<3>() = gimbal_drift(axes, rates) + axes * accelerations;
  i = translations_;
  for (int k = 0; k < 3; ++k)
    if (freedoms_[3 + k].is_state()) m.map.col(i++).tail<3>() = axes.col(k);
}

void Mount::position_rates(std::span<const double> positions, std::span<const double> speeds,
                           std::span<double> rates) const {
  const int copied = gimbal_ ? speed_size() : translations_;
  for (int i = 0; i < copied; ++i) rates[i] = speeds[i];
  if (!gimbal_) Vec4::Map(&rates[copied]) = quaternion_rate(Vec4::Map(&positions[copied]), Vec3::Map(&speeds[copied]));
}

}  // namespace windhover::body
