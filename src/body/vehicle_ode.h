// The right-hand side of a vehicle's motion: rigid body, mount, rotors, motors (numerics: Newton–Euler).
#pragma once
#include <span>
#include <vector>

#include "body/loads.h"
#include "body/ode.h"
#include "body/vehicle.h"

namespace windhover::body {

/// Motion of the body, seen from the inertial frame.
struct Kinematics {
  Vec3 p_WoG_W, v_WG_W;  ///< centre of gravity
  Mat3 R_WB;
  Vec3 omega_WB_B;

  Vec3 omega_WB_W() const { return R_WB * omega_WB_B; }
};

/// State: positions of the mount | their speeds | rotor speeds | rotor angles. For a free body the positions are that of
/// the mount's point (the centre of gravity by default) and the quaternion, the speeds that point's velocity (inertial
/// axes) and the angular velocity (body axes).
class VehicleOde {
 public:
  explicit VehicleOde(Vehicle vehicle);

  const Vehicle& vehicle() const { return vehicle_; }
  int size() const { return rotor_angle_offset() + rotors(); }
  int rotors() const { return static_cast<int>(vehicle_.rotors.size()); }
  int rotor_speed_offset() const { return vehicle_.mount.position_size() + vehicle_.mount.speed_size(); }
  int rotor_angle_offset() const { return rotor_speed_offset() + rotors(); }

  std::vector<double> initial_state() const;
  Kinematics kinematics(double t, std::span<const double> y) const;

  /// Pure. `loads` as in LoadLayout; `command`: speed of each rotor (rad/s), see motor.h. y and rate may be longer than
  /// size(): what follows belongs to the caller.
  void derivative(double t, std::span<const double> y, std::span<const double> loads, std::span<const double> command,
                  std::span<double> rate) const;

  /// What is left of the forces (N, N m) on each of the mount's speeds when the vehicle does not turn and its rotors keep
  /// their speeds: air, gravity and springs. Zero: it stays as it is. For a free body: along the inertial axes, then about
  /// the body axes and the mount's point.
  Speeds unbalanced(double t, std::span<const double> y, std::span<const double> loads) const;

  /// Back to a quaternion of length 1.
  void project(std::span<double> y) const;

 private:
  std::span<const double> positions(std::span<const double> y) const;
  std::span<const double> speeds(std::span<const double> y) const;

  Vehicle vehicle_;
};

/// The ODE of a window without controller: given loads, constant commands. The references must outlive it.
Ode vehicle_ode(const VehicleOde& vehicle, const LoadPolynomial& loads, const std::vector<double>& command);

}  // namespace windhover::body
