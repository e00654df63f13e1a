#include "body/vehicle_ode.h"

#include <Eigen/Cholesky>

namespace windhover::body {
namespace {

using Mat6 = Eigen::Matrix<double, 6, 6>;

Mat3 cross_matrix(const Vec3& a) { return (Mat3() << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0).finished(); }

/// (acceleration of the centre of gravity, angular acceleration) = this · (that of P, angular acceleration), at rest.
Mat6 to_center(const Mat3& R_WB, const Vec3& p_PG_B) {
  Mat6 map = Mat6::Identity();
  map.topRightCorner<3, 3>() = -R_WB * cross_matrix(p_PG_B);
  return map;
}

/// What the rotors add to the equations of the body.
struct RotorSums {
  Mat3 free_inertia = Mat3::Zero();  ///< of rotors that turn under torque: the body does not turn it about their axes
  Vec3 momentum_B = Vec3::Zero();    ///< of their rotation relative to the body
  Vec3 reaction_B = Vec3::Zero();    ///< torque that accelerates them, taken from the body
};

/// Fills the rates of the rotor speeds, those of free rotors as if the body did not accelerate.
RotorSums turn_rotors(double t, const std::vector<Rotor>& rotors, const double* speed, const double* air_torque,
                      const double* command, double* speed_rate) {
  RotorSums sums;
  for (std::size_t j = 0; j < rotors.size(); ++j) {
    const Vec3& axis = rotors[j].spin_axis_B;
    const double inertia = rotors[j].inertia;
    if (const auto* servo = std::get_if<ServoMotor>(&rotors[j].motor_at(t))) {
      speed_rate[j] = servo->acceleration(command[j], speed[j]);
    } else {
      const auto& motor = std::get<TorqueMotor>(rotors[j].motor_at(t));
      speed_rate[j] = (motor.torque(command[j], speed[j]) + air_torque[j]) / inertia;
      sums.free_inertia += inertia * axis * axis.transpose();
    }
    sums.momentum_B += inertia * speed[j] * axis;
    sums.reaction_B += inertia * speed_rate[j] * axis;
  }
  return sums;
}

}  // namespace

VehicleOde::VehicleOde(Vehicle vehicle) : vehicle_(std::move(vehicle)) {}

std::span<const double> VehicleOde::positions(std::span<const double> y) const {
  return y.first(vehicle_.mount.position_size());
}
std::span<const double> VehicleOde::speeds(std::span<const double> y) const {
  return y.subspan(vehicle_.mount.position_size(), vehicle_.mount.speed_size());
}

std::vector<double> VehicleOde::initial_state() const {
  std::vector<double> y(size());
  const std::span<double> all(y);
  const Mount& mount = vehicle_.mount;
  mount.initial(all.first(mount.position_size()), all.subspan(mount.position_size(), mount.speed_size()));
  for (int j = 0; j < rotors(); ++j) {
    y[rotor_speed_offset() + j] = vehicle_.rotors[j].speed;
    y[rotor_angle_offset() + j] = vehicle_.rotors[j].angle;
  }
  return y;
}

Kinematics VehicleOde::kinematics(double t, std::span<const double> y) const {
  const MountMotion m = vehicle_.mount.evaluate(t, positions(y), speeds(y));
  const Vec3 p_PG_B = -vehicle_.p_GP_B;
  return {m.p_WoP_W + m.R_WB * p_PG_B, m.v_WP_W + m.R_WB * m.omega_WB_B.cross(p_PG_B), m.R_WB, m.omega_WB_B};
}

void VehicleOde::derivative(double t, std::span<const double> y, std::span<const double> loads,
                            std::span<const double> command, std::span<double> rate) const {
  const Mount& mount = vehicle_.mount;
  const MountMotion m = mount.evaluate(t, positions(y), speeds(y));
  const Vec3& omega = m.omega_WB_B;
  const double* rotor_speed = y.data() + rotor_speed_offset();
  double* rotor_rate = rate.data() + rotor_speed_offset();
  const RotorSums sums =
      turn_rotors(t, vehicle_.rotors, rotor_speed, loads.data() + LoadLayout::rotor, command.data(), rotor_rate);

  // Newton–Euler for the accelerations of P and the angular accelerations; v̇_G = a_P + R (ω̇ × p + ω × (ω × p)).
  const Vec3 p_PG_B = -vehicle_.p_GP_B;
  const Mat6 to_center = body::to_center(m.R_WB, p_PG_B);
  Mat6 mass = Mat6::Zero();
  mass.topLeftCorner<3, 3>() = vehicle_.mass * Mat3::Identity();
  mass.bottomRightCorner<3, 3>() = vehicle_.inertia_BG_B - sums.free_inertia;
  Vec6 force;
  force.head<3>() = Vec3::Map(&loads[LoadLayout::force]) +
                    vehicle_.mass * (vehicle_.gravity_W - m.R_WB * omega.cross(omega.cross(p_PG_B)));
  force.tail<3>() = m.R_WB.transpose() * Vec3::Map(&loads[LoadLayout::torque]) -
                    omega.cross(vehicle_.inertia_BG_B * omega + sums.momentum_B) - sums.reaction_B;
  mass = to_center.transpose() * mass * to_center;
  force = to_center.transpose() * force;

  // Onto the motions that the mount permits.
  const Speeds right = m.map.transpose() * (force - mass * m.drift) + m.force;
  const SpeedMatrix left = m.map.transpose() * mass * m.map;
  const Speeds acceleration = left.ldlt().solve(right);
  const Vec3 angular_acceleration = (m.map * acceleration + m.drift).tail<3>();

  mount.position_rates(positions(y), speeds(y), rate.first(mount.position_size()));
  std::copy_n(acceleration.data(), mount.speed_size(), rate.data() + mount.position_size());
  std::copy_n(rotor_speed, rotors(), rate.data() + rotor_angle_offset());
  for (int j = 0; j < rotors(); ++j)
    if (std::holds_alternative<TorqueMotor>(vehicle_.rotors[j].motor_at(t)))
      rotor_rate[j] -= vehicle_.rotors[j].spin_axis_B.dot(angular_acceleration);
}

Speeds VehicleOde::unbalanced(double t, std::span<const double> y, std::span<const double> loads) const {
  const MountMotion m = vehicle_.mount.evaluate(t, positions(y), speeds(y));
  Vec6 force;
  force.head<3>() = Vec3::Map(&loads[LoadLayout::force]) + vehicle_.mass * vehicle_.gravity_W;
  force.tail<3>() = m.R_WB.transpose() * Vec3::Map(&loads[LoadLayout::torque]);
  return m.map.transpose() * (to_center(m.R_WB, -vehicle_.p_GP_B).transpose() * force) + m.force;
}

void VehicleOde::project(std::span<double> y) const {
  if (const auto offset = vehicle_.mount.quaternion()) Vec4::Map(&y[*offset]).normalize();
}

Ode vehicle_ode(const VehicleOde& vehicle, const LoadPolynomial& loads, const std::vector<double>& command) {
  return {.derivative =
              [&, values = std::vector<double>(loads.size())](double t, auto y, auto rate) mutable {
                loads.evaluate(t, values);
                vehicle.derivative(t, y, values, command, rate);
              },
          .project = [&](std::span<double> y) { vehicle.project(y); }};
}

}  // namespace windhover::body
