#include "body/vehicle.h"

#include <Eigen/Eigenvalues>
#include <numbers>
#include <set>

#include "base/errors.h"

namespace windhover::body {
namespace {

Mat3 inertia_tensor(const VehicleOptions& o, const std::string& prefix) {
  const Vec3 &moments = o.inertia_kg_m2, &products = o.inertia_products_kg_m2;
  Mat3 inertia = moments.asDiagonal();
  inertia(0, 1) = inertia(1, 0) = -products[0];
  inertia(0, 2) = inertia(2, 0) = -products[1];
  inertia(1, 2) = inertia(2, 1) = -products[2];
  const Vec3 principal = Eigen::SelfAdjointEigenSolver<Mat3>(inertia, Eigen::EigenvaluesOnly).eigenvalues();
  if (!(principal[0] > 1e-12 * principal[2]))
    throw UserError(
        "{0}inertia_kg_m2: the tensor with {0}inertia_products_kg_m2 is singular or negative "
        "(principal moments {1}, {2}, {3})",
        prefix, principal[0], principal[1], principal[2]);
  if (principal[2] > (principal[0] + principal[1]) * (1 + 1e-9))
    throw UserError(
        "{}inertia_kg_m2: no body has principal moments {}, {}, {}: the largest exceeds the sum of the others", prefix,
        principal[0], principal[1], principal[2]);
  return inertia;
}

void require_positive(double value, const std::string& key) {
  if (!(value > 0)) throw UserError("{}: is {}, must be > 0", key, value);
}

Motor build_motor(const MotorOptions& o, const std::string& prefix) {
  if (o.kind == "servo") {
    require_positive(o.time_constant_s, prefix + "time_constant_s");
    return ServoMotor{o.time_constant_s};
  }
  if (o.kind != "torque") throw UserError("{}kind: a rotor needs a motor: \"servo\" or \"torque\"", prefix);
  require_positive(o.torque_constant_Nm_A, prefix + "torque_constant_Nm_A");
  require_positive(o.resistance_ohm, prefix + "resistance_ohm");
  require_positive(o.supply_V, prefix + "supply_V");
  return TorqueMotor{o.torque_constant_Nm_A, o.resistance_ohm, o.supply_V,
                     o.friction_Nm,          o.friction_Nm_s,  o.governor_V_s};
}

std::vector<Rotor> build_rotors(const VehicleOptions& o, const Mat3& inertia, const std::string& prefix) {
  std::vector<Rotor> rotors;
  std::set<std::string> names;
  Mat3 rest = inertia;  // what resists the reaction of free rotors
  for (std::size_t j = 0; j < o.rotor.size(); ++j) {
    const RotorOptions& r = o.rotor[j];
    const std::string key = fmt::format("{}rotor[{}].", prefix, j);
    if (r.name.empty()) throw UserError("{}name: a rotor needs a name", key);
    if (!names.insert(r.name).second) throw UserError("{}name: a second rotor \"{}\"", key, r.name);
    require_positive(r.inertia_kg_m2, key + "inertia_kg_m2");
    require_positive(r.spin_axis.norm(), key + "spin_axis");
    const Vec3 axis = r.spin_axis.normalized();
    rest -= r.inertia_kg_m2 * axis * axis.transpose();
    rotors.push_back({r.name, r.inertia_kg_m2, axis, r.speed_rad_s, r.angle_rad, build_motor(r.motor, key + "motor.")});
    if (!r.off_at_s) continue;
    rotors.back().off_at = *r.off_at_s;
    rotors.back().off = without_current(r.motor.friction_Nm, r.motor.friction_Nm_s);
  }
  const double smallest = Eigen::SelfAdjointEigenSolver<Mat3>(rest, Eigen::EigenvaluesOnly).eigenvalues()[0];
  if (!(smallest > 1e-12 * inertia.norm()))
    throw UserError("{}inertia_kg_m2: smaller than that of the rotors, which it must include", prefix);
  return rotors;
}

Freedom build_freedom(const FreedomOptions& o, double initial, double initial_rate, const std::string& key) {
  const bool spring_given = o.stiffness != 0 || o.damping != 0 || o.preload != 0 || o.rest != 0;
  const bool motion_given = o.mean != 0 || o.rate != 0 || o.amplitude != 0;
  if (o.kind != "spring" && spring_given)
    throw UserError("{}: stiffness, damping, preload or rest given, but the axis is {}; use kind = \"spring\"", key,
                    o.kind);
  if (o.kind != "prescribed" && motion_given)
    throw UserError("{}: a motion is given, but the axis is {}; use kind = \"prescribed\"", key, o.kind);
  if (o.kind == "spring" && (o.stiffness < 0 || o.damping < 0 || (o.stiffness == 0 && o.damping == 0)))
    throw UserError("{}: a spring needs stiffness or damping above 0, and none below", key);
  if (o.kind == "locked" && initial_rate != 0)
    throw UserError("{}: locked, but its initial velocity is {}", key, initial_rate);
  if (o.kind == "prescribed" && (initial != 0 || initial_rate != 0))
    throw UserError("{}: prescribed, but an initial value is given as well", key);
  Freedom freedom{.motion = {},
                  .stiffness = o.stiffness,
                  .damping = o.damping,
                  .preload = o.preload,
                  .rest = o.rest,
                  .initial = initial,
                  .initial_rate = initial_rate};
  if (o.kind == "locked") freedom.motion = Signal{.mean = initial};
  if (o.kind == "prescribed")
    freedom.motion = Signal{o.mean, o.rate, o.amplitude, 2 * std::numbers::pi * o.frequency_hz, o.phase_rad};
  return freedom;
}

Mount build_mount(const VehicleOptions& o, const std::string& prefix) {
  const MountOptions& m = o.mount;
  const FreedomOptions* list[] = {&m.x, &m.y, &m.z, &m.rotation_x, &m.rotation_y, &m.rotation_z};
  std::array<Freedom, 6> freedoms;
  int rotations = 0;
  for (int k = 0; k < 6; ++k) {
    const double initial = k < 3 ? o.position_m[k] : o.rotation_rad[k - 3];
    const double rate = k < 3 ? o.velocity_m_s[k] : o.rotation_rate_rad_s[k - 3];
    freedoms[k] = build_freedom(*list[k], initial, rate, prefix + "mount." + kFreedomNames[k]);
    if (k >= 3) rotations += freedoms[k].is_state();
  }
  // A gimbal whose outer and inner axes fall together has lost one of its motions.
  if (rotations == 2 && freedoms[3].is_state() && freedoms[4].is_state()) {
    const Signal& pitch = *freedoms[5].motion;
    if (std::abs(std::cos(pitch.value(0))) < 1e-6)
      throw UserError("{}mount.rotation_z: at 90° the axes of rotation_x and rotation_y fall together", prefix);
  }
  return Mount(freedoms);
}

}  // namespace

Vehicle build_vehicle(const VehicleOptions& o, const std::string& prefix) {
  require_positive(o.mass_kg, prefix + "mass_kg");
  const Mat3 inertia = inertia_tensor(o, prefix);
  return {
      o.mass_kg, inertia, o.gravity_m_s2, o.mount.point_m, build_mount(o, prefix), build_rotors(o, inertia, prefix)};
}

}  // namespace windhover::body
