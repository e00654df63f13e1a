// Rigid motion of zones: poses, their velocities, and prescribed motions that compose.
#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <variant>
#include <vector>

#include "base/signal.h"

namespace windhover::mesh {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// Where a frame is and how it moves, seen from the inertial frame: a point r of the frame is at
/// x + R r and has the velocity V + omega × (R r).
struct FrameState {
  Mat3 R = Mat3::Identity();
  Vec3 x = Vec3::Zero();
  Vec3 V = Vec3::Zero();      ///< velocity of the frame's origin, inertial axes
  Vec3 omega = Vec3::Zero();  ///< angular velocity, inertial axes

  Vec3 position(const Vec3& r) const { return x + R * r; }
  Vec3 velocity(const Vec3& r) const { return V + omega.cross(R * r); }
  bool operator==(const FrameState&) const = default;
};

/// The frame `inner`, given relative to `outer`, seen from outside.
FrameState compose(const FrameState& outer, const FrameState& inner);

/// Translation along a fixed direction.
struct Translation {
  Vec3 direction = Vec3::UnitX();  ///< unit vector
  Signal distance;
};

/// Rotation about an axis through a fixed point; the angle in radians.
struct Rotation {
  Vec3 axis = Vec3::UnitZ();  ///< unit vector
  Vec3 point = Vec3::Zero();
  Signal angle;
};

/// Elementary motions, the first outermost: the frame is carried by all of them in turn.
using Motion = std::vector<std::variant<Translation, Rotation>>;

FrameState evaluate(const Motion& motion, double t);

}  // namespace windhover::mesh
