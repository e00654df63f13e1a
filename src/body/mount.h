// The mount: which motions a body has, and the springs that hold it. A free body is the mount that holds nothing.
#pragma once
#include <array>
#include <optional>
#include <span>

#include "base/signal.h"
#include "body/attitude.h"

namespace windhover::body {

using Vec6 = Eigen::Matrix<double, 6, 1>;
/// At most six rows or columns, never on the heap.
using Speeds = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1>;
using SpeedMap = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, 6>;
using SpeedMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;

/// The degrees of freedom in their order, as the case calls them.
inline constexpr std::array<const char*, 6> kFreedomNames = {"x", "y", "z", "rotation_x", "rotation_y", "rotation_z"};

/// Coordinate of one degree of freedom: a function of time (locked, prescribed), or a state under a spring's force.
struct Freedom {
  std::optional<Signal> motion = {};
  double stiffness = 0, damping = 0, preload = 0, rest = 0;
  double initial = 0, initial_rate = 0;

  bool is_state() const { return !motion; }
  bool sprung() const { return stiffness != 0 || damping != 0 || preload != 0; }
  double force(double x, double rate) const { return preload - stiffness * (x - rest) - damping * rate; }
};

/// Motion of the body about the mount's point P, and what the mount permits and does.
struct MountMotion {
  Vec3 p_WoP_W, v_WP_W;
  Mat3 R_WB;
  Vec3 omega_WB_B;
  SpeedMap map;  ///< (acceleration of P in W, angular acceleration in B) = map · d(speeds)/dt + drift
  Vec6 drift;
  Speeds force;  ///< of springs and dampers, on the speeds
};

/// The six coordinates are the position of P in inertial axes and the gimbal angles (attitude.h). Only those that are
/// free or on springs are states. When all three rotations are, the states are a quaternion and the angular velocity in
/// body axes, so that a free body knows no gimbal lock.
class Mount {
 public:
  explicit Mount(const std::array<Freedom, 6>& freedoms);

  int position_size() const { return translations_ + (gimbal_ ? rotations_ : 4); }
  int speed_size() const { return translations_ + rotations_; }
  void initial(std::span<double> positions, std::span<double> speeds) const;

  /// The states at given coordinates and rates; those that are no states are left out. And the coordinates at states.
  void place(const Vec6& coordinates, const Vec6& rates, std::span<double> positions, std::span<double> speeds) const;
  Vec6 coordinates(double t, std::span<const double> positions) const;
  const std::array<Freedom, 6>& freedoms() const { return freedoms_; }

  MountMotion evaluate(double t, std::span<const double> positions, std::span<const double> speeds) const;
  void position_rates(std::span<const double> positions, std::span<const double> speeds, std::span<double> rates) const;

  /// Offset of the quaternion in the positions, if there is one.
  std::optional<int> quaternion() const { return gimbal_ ? std::nullopt : std::optional<int>(translations_); }

 private:
  void translate(double t, std::span<const double> positions, std::span<const double> speeds, MountMotion& m) const;
  void rotate_freely(std::span<const double> positions, std::span<const double> speeds, MountMotion& m) const;
  void rotate_in_gimbal(double t, std::span<const double> positions, std::span<const double> speeds,
                        MountMotion& m) const;

  std::array<Freedom, 6> freedoms_;
  int translations_ = 0, rotations_ = 0;  ///< that are states
  bool gimbal_ = false;                   ///< some rotation is no state: angles instead of a quaternion
};

}  // namespace windhover::body
