// Mounts against exact answers: springs, dampers, locks, prescribed motion, the pitch–plunge section.
#include <Eigen/Eigenvalues>

#include "body_fixture.h"

using namespace windhover;
using namespace windhover::body;

namespace {

/// x(t) of m ẍ + c ẋ + k (x - rest) = preload from x0, v0.
double damped(double m, double c, double k, double center, double x0, double v0, double t) {
  const double decay = c / (2 * m), w = std::sqrt(k / m - decay * decay), a = x0 - center;
  return center + std::exp(-decay * t) * (a * std::cos(w * t) + (v0 + decay * a) / w * std::sin(w * t));
}

}  // namespace

TEST_CASE("spring, mass and damper with preload follow the exact solution") {
  VehicleOptions o = brick();
  lock_all(o.mount);
  o.position_m = Vec3(0.3, 1, 2);
  o.velocity_m_s = Vec3(0.4, 0, 0);
  o.mount.x.kind = "spring";
  o.mount.x.stiffness = 60, o.mount.x.damping = 1.3, o.mount.x.preload = 5, o.mount.x.rest = 0.1;
  o.mount.rotation_z.kind = "spring";
  o.rotation_rad = Vec3(0, 0, 0.2);
  o.mount.rotation_z.stiffness = 3, o.mount.rotation_z.damping = 0.02;
  for (const std::string method : kMethods) {
    const VehicleOde ode(build_vehicle(o));
    CHECK(ode.size() == 4);
    std::vector<double> y = ode.initial_state();
    fly(ode, 0, 5, y, tight(method));
    const Kinematics k = ode.kinematics(5, y);
    CHECK(k.p_WoG_W.x() == Approx(damped(1.7, 1.3, 60, 0.1 + 5.0 / 60, 0.3, 0.4, 5)).margin(1e-10));
    CHECK(k.p_WoG_W.tail<2>() == Eigen::Vector2d(1, 2));
    CHECK(gimbal_angles(k.R_WB).z() == Approx(damped(0.024, 0.02, 3, 0, 0.2, 0, 5)).margin(1e-10));
  }
}

TEST_CASE("springs on a body whose rotations are all free: small motion about each axis") {
  VehicleOptions o = brick();
  const int axis = GENERATE(0, 1, 2);
  RotationOptions* rotations[] = {&o.mount.rotation_x, &o.mount.rotation_y, &o.mount.rotation_z};
  for (RotationOptions* rotation : rotations)
    rotation->kind = "spring", rotation->stiffness = 2, rotation->damping = 0.01;
  o.rotation_rad[axis] = 0.3;  // about one axis alone the motion is exactly linear
  const VehicleOde ode(build_vehicle(o));
  std::vector<double> y = ode.initial_state();
  fly(ode, 0, 2, y, tight());
  Vec3 expected = Vec3::Zero();
  expected[axis] = damped(o.inertia_kg_m2[axis], 0.01, 2, 0, 0.3, 0, 2);
  CHECK((gimbal_angles(ode.kinematics(2, y).R_WB) - expected).norm() < 1e-9);
}

TEST_CASE("undamped springs keep the energy of a motion through large angles") {
  VehicleOptions o = brick();
  RotationOptions* rotations[] = {&o.mount.rotation_x, &o.mount.rotation_y, &o.mount.rotation_z};
  const double stiffness[] = {2, 3, 4};
  for (int k = 0; k < 3; ++k) rotations[k]->kind = "spring", rotations[k]->stiffness = stiffness[k];
  const bool gimbal = GENERATE(false, true);
  if (gimbal) o.mount.rotation_y.kind = "locked", o.mount.rotation_y.stiffness = 0;
  o.mount.point_m = Vec3(0.05, -0.02, 0.1);
  o.rotation_rad = Vec3(0.8, gimbal ? 0.0 : -0.6, 0.7);
  const VehicleOde ode(build_vehicle(o));
  const auto energy = [&](double t, const std::vector<double>& y) {
    const Vec3 a = gimbal_angles(ode.kinematics(t, y).R_WB);
    return invariants(ode, t, y).energy + 0.5 * (2 * a.x() * a.x() + 3 * a.y() * a.y() + 4 * a.z() * a.z());
  };
  std::vector<double> y = ode.initial_state();
  const double before = energy(0, y);
  fly(ode, 0, 3, y, tight());
  CHECK(energy(3, y) == Approx(before).epsilon(1e-9));
  if (gimbal) CHECK(std::abs(gimbal_angles(ode.kinematics(3, y).R_WB).y()) < 1e-15);
}

TEST_CASE("a compound pendulum swings with its exact period") {
  VehicleOptions o = brick();
  lock_all(o.mount);
  o.gravity_m_s2 = Vec3(0, -9.81, 0);
  o.mount.point_m = Vec3(0, 0.4, 0);
  o.mount.rotation_z.kind = "free";
  o.rotation_rad = Vec3(0, 0, 1e-4);
  const VehicleOde ode(build_vehicle(o));
  std::vector<double> y = ode.initial_state();
  const double w = std::sqrt(1.7 * 9.81 * 0.4 / (0.024 + 1.7 * 0.4 * 0.4));
  fly(ode, 0, 2 * kPi / w, y, tight());
  CHECK(y[0] == Approx(1e-4).epsilon(1e-7));
  CHECK(std::abs(y[1]) < 1e-4 * w * 1e-7);
}

TEST_CASE("prescribed motion is exact and drives what is free") {
  VehicleOptions o = brick();
  lock_all(o.mount);
  o.mount.point_m = Vec3(0.1, 0, 0);
  o.mount.rotation_z.kind = "prescribed";
  o.mount.rotation_z.mean = 0.1, o.mount.rotation_z.amplitude = 0.3, o.mount.rotation_z.frequency_hz = 2;
  o.mount.y.kind = "free";
  const VehicleOde ode(build_vehicle(o));
  std::vector<double> y = ode.initial_state();
  const Vec3 before = ode.kinematics(0, y).v_WG_W;
  fly(ode, 0, 1.3, y, tight());
  const Kinematics k = ode.kinematics(1.3, y);
  CHECK(gimbal_angles(k.R_WB).z() == Approx(0.1 + 0.3 * std::sin(4 * kPi * 1.3)).epsilon(1e-14));
  CHECK(k.omega_WB_B.z() == Approx(0.3 * 4 * kPi * std::cos(4 * kPi * 1.3)).epsilon(1e-14));
  CHECK(k.v_WG_W.y() == Approx(before.y()).margin(1e-11));  // no force along y: that momentum stays
}

TEST_CASE("locked and prescribed on every axis: nothing to integrate") {
  VehicleOptions o = brick();
  lock_all(o.mount);
  const VehicleOde ode(build_vehicle(o));
  std::vector<double> y = ode.initial_state();
  CHECK(y.empty());
  fly(ode, 0, 1, y, tight());
  o.rotor.push_back(rotor("r", Vec3::UnitY(), 1e-4, "servo"));
  const VehicleOde held(build_vehicle(o));
  y = held.initial_state();
  fly(held, 0, 1, y, tight(), {100});
  CHECK(y[0] == Approx(100).epsilon(1e-8));
}

TEST_CASE("pitch–plunge section: Isogai's wind-off frequencies") {
  const double b = 0.5, mass = 12, w = 100, offset = 1.8 * b, elastic = 3.48 * mass * b * b;
  VehicleOptions o = brick();
  lock_all(o.mount);
  o.mass_kg = mass;
  const double central = elastic - mass * offset * offset;
  o.inertia_kg_m2 = Vec3(central, central, central);
  o.mount.point_m = Vec3(offset, 0, 0);  // the elastic axis lies ahead of the centre of gravity
  o.mount.y.kind = o.mount.rotation_z.kind = "spring";
  o.mount.y.stiffness = mass * w * w;
  o.mount.rotation_z.stiffness = elastic * w * w;
  const VehicleOde ode(build_vehicle(o));
  const Eigen::VectorXd loads = Eigen::VectorXd::Zero(6);

  Eigen::Matrix4d jacobian;
  const double h = 1e-6;
  for (int j = 0; j < 4; ++j) {
    std::array<std::vector<double>, 2> rate;
    for (const int side : {0, 1}) {
      std::vector<double> y = ode.initial_state();
      y[j] = side ? h : -h;
      rate[side].resize(4);
      ode.derivative(0, y, {loads.data(), 6}, {}, rate[side]);
    }
    for (int i = 0; i < 4; ++i) jacobian(i, j) = (rate[1][i] - rate[0][i]) / (2 * h);
  }
  Eigen::Vector4d frequencies = jacobian.eigenvalues().imag().cwiseAbs() / w;
  std::sort(frequencies.begin(), frequencies.end());
  CHECK(frequencies[0] == Approx(0.7134).margin(5e-5));
  CHECK(frequencies[3] == Approx(5.3377).margin(5e-5));
}
