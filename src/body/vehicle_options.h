// What a user says about the vehicle: SI units, radians, body axes x forward, y up, z right at the centre of gravity.
#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace windhover::body {

using Vec3 = Eigen::Vector3d;

struct MotorOptions {
  std::string kind = "none";
  double time_constant_s = 0.03;
  double torque_constant_Nm_A = 0, resistance_ohm = 0, supply_V = 0;
  double friction_Nm = 0, friction_Nm_s = 0, governor_V_s = 0;
};

struct RotorOptions {
  std::string name;
  double inertia_kg_m2 = 0;
  Vec3 spin_axis = Vec3::UnitY();  ///< right-handed: a positive speed turns about it
  double speed_rad_s = 0, angle_rad = 0;
  std::optional<double> off_at_s = {};
  MotorOptions motor;
};

/// One degree of freedom of the mount: m and N for translations, rad and N m for rotations.
struct FreedomOptions {
  std::string kind = "free";
  double stiffness = 0, damping = 0, preload = 0, rest = 0;
  double mean = 0, rate = 0, amplitude = 0, frequency_hz = 0, phase_rad = 0;
};
struct TranslationOptions : FreedomOptions {};
struct RotationOptions : FreedomOptions {};

struct MountOptions {
  Vec3 point_m = Vec3::Zero();
  TranslationOptions x, y, z;
  RotationOptions rotation_x, rotation_y, rotation_z;
};

struct VehicleOptions {
  double mass_kg = 0;
  Vec3 inertia_kg_m2 = Vec3::Zero();           ///< Ixx, Iyy, Izz
  Vec3 inertia_products_kg_m2 = Vec3::Zero();  ///< ∫xy dm, ∫xz dm, ∫yz dm
  Vec3 gravity_m_s2 = Vec3(0, -9.80665, 0);
  Vec3 position_m = Vec3::Zero(), velocity_m_s = Vec3::Zero();
  Vec3 rotation_rad = Vec3::Zero(), rotation_rate_rad_s = Vec3::Zero();
  MountOptions mount;
  std::vector<RotorOptions> rotor;
};

}  // namespace windhover::body
