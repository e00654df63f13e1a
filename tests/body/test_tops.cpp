// Rotation against exact answers: free top, heavy top, gyroscopes.
#include "body_fixture.h"
#include "oracle/free_top.h"

using namespace windhover;
using namespace windhover::body;

namespace {

/// Inertia given as a full tensor, by principal moments and the rotation from principal to body axes.
void set_inertia(VehicleOptions& o, const Vec3& moments, const Mat3& R_BP) {
  const Mat3 inertia = R_BP * moments.asDiagonal() * R_BP.transpose();
  o.inertia_kg_m2 = inertia.diagonal();
  o.inertia_products_kg_m2 = Vec3(-inertia(0, 1), -inertia(0, 2), -inertia(1, 2));
}

}  // namespace

TEST_CASE("Jacobi's functions: identities, special values and derivative") {
  CHECK(oracle::quarter_period(0.5) == Approx(1.8540746773013719).epsilon(1e-15));
  CHECK(oracle::jacobi(oracle::quarter_period(0.3), 0.3).sn == Approx(1).epsilon(1e-15));
  const double u = 0.7, k2 = 0.6, h = 1e-3;
  const auto sn = [&](double x) { return oracle::jacobi(x, k2).sn; };
  const auto j = oracle::jacobi(u, k2);
  CHECK(j.sn * j.sn + j.cn * j.cn == Approx(1).epsilon(1e-15));
  CHECK((8 * (sn(u + h) - sn(u - h)) - sn(u + 2 * h) + sn(u - 2 * h)) / (12 * h) == Approx(j.cn * j.dn).epsilon(1e-10));
}

TEST_CASE("asymmetric top: 100 periods against elliptic functions, energy and momentum kept") {
  const std::string method = GENERATE("adams", "bdf");
  const oracle::FreeTop top{{0.02, 0.03, 0.045}, {4, 0, 6}};
  const Mat3 R_BP = gimbal_rotation({0.4, -0.9, 0.3}), R_WB = gimbal_rotation({1.1, 0.2, -0.5});
  VehicleOptions o = brick();
  set_inertia(o, top.moments, R_BP);
  o.rotation_rad = gimbal_angles(R_WB);
  o.rotation_rate_rad_s = gimbal_axes(o.rotation_rad).inverse() * (R_BP * top.omega_0);
  const VehicleOde ode(build_vehicle(o));
  std::vector<double> y = ode.initial_state();
  const Invariants before = invariants(ode, 0, y);

  const double end = 100 * top.period();
  fly(ode, 0, end, y, tight(method));
  const Kinematics k = ode.kinematics(end, y);
  const Invariants after = invariants(ode, end, y);
  const double omega_error = (k.omega_WB_B - R_BP * top.omega(end)).norm() / top.omega_0.norm();
  const Eigen::AngleAxisd turn(100 * top.turn_per_period(), before.momentum_W.normalized());
  const double attitude_error = (k.R_WB - turn * R_WB).norm();
  const double energy_drift = std::abs(after.energy / before.energy - 1);
  const double momentum_drift = (after.momentum_W - before.momentum_W).norm() / before.momentum_W.norm();
  INFO(method << ": errors of omega " << omega_error << ", attitude " << attitude_error << "; drift of energy "
              << energy_drift << ", momentum " << momentum_drift);
  CHECK(omega_error < 1e-7);
  CHECK(attitude_error < 1e-6);
  CHECK(energy_drift < 1e-8);
  CHECK(momentum_drift < 1e-8);
  CHECK(Vec4::Map(&y[3]).norm() == Approx(1).epsilon(1e-15));
}

namespace {

struct HeavyTop {
  VehicleOptions o = brick();
  double distance = 0.12;  ///< of the centre of gravity from the pivot, along body x
  double tilt = 0.5;       ///< of body x above the horizontal
  double axial = 0.01, transverse;

  HeavyTop() {
    o.gravity_m_s2 = Vec3(0, -9.81, 0);
    o.inertia_kg_m2 = Vec3(axial, 0.006, 0.006);
    transverse = 0.006 + o.mass_kg * distance * distance;
    o.mount.point_m = Vec3(-distance, 0, 0);
    o.mount.x.kind = o.mount.y.kind = o.mount.z.kind = "locked";
    o.rotation_rad = Vec3(0, 0, tilt);
  }
  /// Momentum about its own axis with which the top precesses steadily at the given rate.
  double momentum(double precession) const {
    return o.mass_kg * 9.81 * distance / precession + transverse * precession * std::sin(tilt);
  }
};

/// Yaw angle reached from steady precession, over the angle in theory; the tilt must stay.
double precession_ratio(const HeavyTop& top, double precession, const std::vector<double>& command) {
  const VehicleOde ode(build_vehicle(top.o));
  std::vector<double> y = ode.initial_state();
  const double end = 3 / precession;  // less than half a turn
  fly(ode, 0, end, y, tight(), command);
  const Vec3 angles = gimbal_angles(ode.kinematics(end, y).R_WB);
  CHECK(angles.z() == Approx(top.tilt).epsilon(1e-8));
  return angles.y() / 3;
}

}  // namespace

TEST_CASE("heavy symmetric top precesses at the rate of theory") {
  HeavyTop top;
  const double precession = 1.9;
  const double spin = top.momentum(precession) / top.axial - precession * std::sin(top.tilt);
  top.o.rotation_rate_rad_s = Vec3(spin, precession, 0);
  CHECK(precession_ratio(top, precession, {}) == Approx(1).epsilon(1e-8));
}

TEST_CASE("a spinning rotor carries a body that does not spin") {
  HeavyTop top;
  const double precession = 0.8, inertia = 0.002;
  const double speed = (top.momentum(precession) - top.axial * precession * std::sin(top.tilt)) / inertia;
  top.o.rotor.push_back(rotor("wheel", Vec3::UnitX(), inertia, "servo"));
  top.o.rotor[0].speed_rad_s = speed;
  top.o.rotation_rate_rad_s = Vec3(0, precession, 0);
  SECTION("free to turn about its axis") {
    CHECK(precession_ratio(top, precession, {speed}) == Approx(1).epsilon(1e-8));
  }
  SECTION("in a gimbal that locks that rotation") {
    top.o.mount.rotation_x.kind = "locked";
    CHECK(precession_ratio(top, precession, {speed}) == Approx(1).epsilon(1e-8));
  }
}

TEST_CASE("fast top: the classic rate m g l / (J Omega) within 0.1 %") {
  HeavyTop top;
  const double inertia = 0.002, speed = 10000;
  const double precession = top.o.mass_kg * 9.81 * top.distance / (inertia * speed);
  top.o.rotor.push_back(rotor("wheel", Vec3::UnitX(), inertia, "servo"));
  top.o.rotor[0].speed_rad_s = speed;  // released at rest: small nutation about the mean
  const VehicleOde ode(build_vehicle(top.o));
  std::vector<double> y = ode.initial_state();
  fly(ode, 0, 5, y, {.method = "adams"}, {speed});
  CHECK(gimbal_angles(ode.kinematics(5, y).R_WB).y() / (5 * precession) == Approx(1).epsilon(1e-3));
}

TEST_CASE("rotors that turn freely exchange energy and momentum with the body, which keep both") {
  VehicleOptions o = brick();
  o.rotation_rate_rad_s = Vec3(3, -2, 5);
  for (const Vec3& axis : {Vec3(0, 1, 0), Vec3(1, 2, -1)}) {
    o.rotor.push_back(rotor(axis.x() == 0 ? "upright" : "oblique", axis, 0.004, "torque"));
    o.rotor.back().motor.resistance_ohm = 1e30;  // no current
    o.rotor.back().speed_rad_s = 40;
  }
  const VehicleOde ode(build_vehicle(o));
  std::vector<double> y = ode.initial_state();
  const Invariants before = invariants(ode, 0, y);
  fly(ode, 0, 20, y, tight(), {0, 0});
  const Invariants after = invariants(ode, 20, y);
  CHECK(after.energy == Approx(before.energy).epsilon(1e-10));
  CHECK((after.momentum_W - before.momentum_W).norm() < 1e-10 * before.momentum_W.norm());
}

TEST_CASE("spin-up of a servo turns a free body the other way: total momentum stays zero") {
  VehicleOptions o = brick();
  o.rotor.push_back(rotor("r", Vec3(0, 1, 0), 0.001, "servo"));
  const VehicleOde ode(build_vehicle(o));
  std::vector<double> y = ode.initial_state();
  fly(ode, 0, 1, y, tight(), {500});
  CHECK(y[ode.rotor_speed_offset()] == Approx(500 * (1 - std::exp(-1 / 0.03))).epsilon(1e-10));
  CHECK(ode.kinematics(1, y).omega_WB_B.y() == Approx(-0.001 * 500 / 0.031).epsilon(1e-10));
  CHECK(invariants(ode, 1, y).momentum_W.norm() < 1e-12);
}
