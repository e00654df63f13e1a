#include "geometry/mass.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "geometry/airframe.h"

using namespace windhover::geometry;

namespace {

PartOptions part(const std::string& kind, double mass) {
  PartOptions p;
  p.kind = kind;
  p.mass_kg = mass;
  return p;
}

PartOptions between(const std::string& kind, const Vec3& from, const Vec3& to, double radius, double mass) {
  PartOptions p = part(kind, mass);
  p.from_m = from;
  p.to_m = to;
  p.radius_m = radius;
  return p;
}

PartOptions box(const Vec3& size, double rounding) {
  PartOptions p = part("box", 0);
  p.size_m = size;
  p.rounding_m = rounding;
  p.density_kg_m3 = 1;
  return p;
}

bool is_diagonal(const Eigen::Matrix3d& m, const Vec3& diagonal) {
  return m.isApprox(Eigen::Matrix3d(diagonal.asDiagonal()), 1e-12);
}

}  // namespace

TEST_CASE("inertia of solids as the books have it") {
  PartOptions p = part("box", 12);
  p.size_m = {2, 3, 4};
  CHECK(is_diagonal(mass_of(p).inertia_kg_m2, {25, 20, 13}));
  PartOptions e = part("ellipsoid", 5);
  e.radii_m = {1, 2, 3};
  CHECK(is_diagonal(mass_of(e).inertia_kg_m2, {13, 10, 5}));
  const auto cylinder = mass_of(between("cylinder", {0, 1, 0}, {0, 5, 0}, 3, 12));  // m (3r² + l²)/12, m r²/2
  CHECK(is_diagonal(cylinder.inertia_kg_m2, {43, 54, 43}));
  CHECK(cylinder.center_m.isApprox(Vec3(0, 3, 0)));
}

TEST_CASE("a capsule is a cylinder and two half balls") {
  PartOptions p = between("capsule", {0, 0, -1}, {0, 0, 1}, 1, 0);
  p.density_kg_m3 = 1;
  const auto m = mass_of(p);
  CHECK(m.mass_kg == Approx(10 * M_PI / 3));
  // 2π (1/4 + 4/12) + 4π/3 (83/320 + (1 + 3/8)²) across, 2π/2 + 4π/3 · 2/5 along
  CHECK(is_diagonal(m.inertia_kg_m2, M_PI * Vec3(121. / 30, 121. / 30, 23. / 15)));
}

TEST_CASE("a box rounded to the full is a ball or a capsule") {
  const auto ball = mass_of(box({2, 2, 2}, 1));
  CHECK(ball.mass_kg == Approx(4 * M_PI / 3));
  CHECK(is_diagonal(ball.inertia_kg_m2, Vec3::Constant(0.4 * 4 * M_PI / 3)));
  const auto capsule = mass_of(box({2, 2, 4}, 1));
  CHECK(capsule.mass_kg == Approx(10 * M_PI / 3));
  CHECK(is_diagonal(capsule.inertia_kg_m2, M_PI * Vec3(121. / 30, 121. / 30, 23. / 15)));
  // 24 less twelve edges' (1 − π/4) ρ² and eight corners' remainders: V = core + faces + edges + corners
  CHECK(mass_of(box({2, 3, 4}, 0.5)).mass_kg == Approx(1 * 2 * 3 + (2 + 6 + 3) + M_PI / 4 * (1 + 2 + 3) + M_PI / 6));
}

TEST_CASE("a slanted cylinder has products of inertia") {
  const auto m = mass_of(between("cylinder", {-1, -1, 0}, {1, 1, 0}, 0.5, 6));  // along: 0.75, across: 4.375
  Eigen::Matrix3d expected;
  expected << 2.5625, -1.8125, 0, -1.8125, 2.5625, 0, 0, 0, 4.375;
  CHECK(m.inertia_kg_m2.isApprox(expected, 1e-12));
}

TEST_CASE("parallel axes") {
  PartOptions ball = part("ellipsoid", 1);
  ball.radii_m = {0.1, 0.1, 0.1};
  ball.center_m = {0, 0, 1};
  PartOptions heavy = ball;
  heavy.mass_kg = 3;
  heavy.center_m = {0, 0, -1};
  const auto dumbbell = combined({mass_of(ball), mass_of(heavy)});
  CHECK(dumbbell.mass_kg == 4);
  CHECK(dumbbell.center_m.isApprox(Vec3(0, 0, -0.5)));
  const double own = 4 * 0.4 * 0.01, steiner = 1 * 1.5 * 1.5 + 3 * 0.5 * 0.5;
  CHECK(is_diagonal(dumbbell.inertia_kg_m2, {own + steiner, own + steiner, own}));
}

TEST_CASE("mirrored parts balance") {
  AirframeOptions airframe;
  airframe.part = {between("capsule", {0.1, 0.2, 0.1}, {0.3, 0.3, 0.4}, 0.02, 0.5)};
  airframe.part[0].mirror = "xz";
  CHECK(all_parts(airframe).size() == 4);
  const auto m = aircraft_mass(airframe, {});
  CHECK(m.mass_kg == Approx(2));
  CHECK(m.center_m.isApprox(Vec3(0, 0.25, 0)));
  CHECK(m.inertia_kg_m2.isDiagonal(1e-12));
  const double own = mass_of(airframe.part[0]).inertia_kg_m2(1, 1);
  CHECK(m.inertia_kg_m2(1, 1) == Approx(4 * (own + 0.5 * (0.2 * 0.2 + 0.25 * 0.25))));
  airframe.part[0].mirror = "x";
  CHECK(aircraft_mass(airframe, {}).center_m.isApprox(Vec3(0, 0.25, 0.25)));
}

TEST_CASE("a rotor is flat, its blades rods with mass as the chord squared") {
  RotorOptions r;
  r.mass_kg = 0.02;
  r.axis = {0, 2, 0};
  r.center_m = {1, 0, 0};
  r.blade.radius_m = 0.5;
  r.blade.r_over_R = {0.25, 1};
  r.blade.c_over_R = {0.1, 0.1};
  r.blade.beta_deg = {0, 0};
  const double gyration = (1 - std::pow(0.25, 3)) / 3 / 0.75 * 0.25;  // ∫r² dr / ∫dr
  CHECK(squared_radius_of_gyration(r.blade) == Approx(gyration).epsilon(1e-6));
  const auto m = mass_of(r);
  CHECK(m.center_m == r.center_m);
  CHECK(is_diagonal(m.inertia_kg_m2 / (0.02 * squared_radius_of_gyration(r.blade)), {0.5, 1, 0.5}));
  CHECK(aircraft_mass({}, {r, r}).mass_kg == Approx(0.04));
}
