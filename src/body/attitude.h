// Attitude of the body axes B in the inertial axes W: quaternions, and the gimbal angles of a mount.
//
// Gimbal angles are right-handed rotations about x, y and z, applied as R_WB = R_y(a.y) R_z(a.z) R_x(a.x):
// the axis of a.y stays vertical, the axis of a.x stays with the body. Roll is a.x, pitch a.z, yaw -a.y.
#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace windhover::body {

using Vec3 = Eigen::Vector3d;
using Vec4 = Eigen::Vector4d;
using Mat3 = Eigen::Matrix3d;

/// q = (w, x, y, z), of any length but zero.
inline Mat3 rotation_of(const Vec4& q) {
  return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
}

inline Vec4 quaternion_of(const Mat3& R_WB) {
  const Eigen::Quaterniond q(R_WB);
  return {q.w(), q.x(), q.y(), q.z()};
}

/// dq/dt = ½ q ⊗ (0, ω).
inline Vec4 quaternion_rate(const Vec4& q, const Vec3& omega_WB_B) {
  Vec4 rate;
  rate[0] = -0.5 * q.tail<3>().dot(omega_WB_B);
  rate.tail<3>() = 0.5 * (q[0] * omega_WB_B + q.tail<3>().cross(omega_WB_B));
  return rate;
}

inline Mat3 gimbal_rotation(const Vec3& angles) {
  using Eigen::AngleAxisd;
  return (AngleAxisd(angles.y(), Vec3::UnitY()) * AngleAxisd(angles.z(), Vec3::UnitZ()) *
          AngleAxisd(angles.x(), Vec3::UnitX()))
      .toRotationMatrix();
}

/// The inverse, with a.z from -90° to 90°.
inline Vec3 gimbal_angles(const Mat3& R_WB) {
  return {std::atan2(-R_WB(1, 2), R_WB(1, 1)), std::atan2(-R_WB(2, 0), R_WB(0, 0)),
          std::asin(std::clamp(R_WB(1, 0), -1.0, 1.0))};
}

/// The axes about which the gimbal angles turn, in body axes: omega_WB_B = gimbal_axes(a) da/dt.
inline Mat3 gimbal_axes(const Vec3& angles) {
  const double cx = std::cos(angles.x()), sx = std::sin(angles.x());
  const double cz = std::cos(angles.z()), sz = std::sin(angles.z());
  Mat3 axes;
  axes.col(0) = Vec3::UnitX();
  axes.col(1) = Vec3(sz, cz * cx, -cz * sx);
  axes.col(2) = Vec3(0, sx, cx);
  return axes;
}

/// d(gimbal_axes)/dt · da/dt: the angular acceleration that is left when the angles do not accelerate.
inline Vec3 gimbal_drift(const Mat3& axes, const Vec3& rates) {
  const Vec3 roll = rates.x() * axes.col(0), pitch = rates.z() * axes.col(2);
  return -rates.z() * roll.cross(axes.col(2)) - rates.y() * (roll + pitch).cross(axes.col(1));
}

}  // namespace windhover::body
