#include "geometry/airframe.h"

#include <catch2/catch.hpp>
#include <fstream>
#include <random>

#include "../io/scratch.h"
#include "base/errors.h"
#include "geometry/rotor.h"
#include "geometry/size_field.h"

using namespace windhover;
using namespace windhover::geometry;
using Catch::Contains;

namespace {

AirframeOptions airframe_of(const std::string& kind) {
  AirframeOptions airframe;
  PartOptions p;
  p.kind = kind;
  p.center_m = {1, 0, 1};
  p.size_m = {2, 1, 4};
  p.radii_m = {2, 1, 4};
  p.from_m = {1, 0, 1};
  p.to_m = {1, 3, 1};
  p.radius_m = 0.5;
  airframe.part.push_back(p);
  return airframe;
}

template <class Change>
std::string error_of(const std::string& kind, Change change) {
  AirframeOptions airframe = airframe_of(kind);
  change(airframe.part[0]);
  try {
    validate(airframe);
  } catch (const UserError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST_CASE("parts that make sense are accepted") {
  for (const char* kind : {"box", "ellipsoid", "cylinder", "capsule"})
    CHECK(error_of(kind, [](PartOptions& p) { p.mirror = "xz"; }) == "no error");
}

TEST_CASE("parts that make no sense are refused") {
  using P = PartOptions;
  CHECK_THAT(error_of("box",
                      [](P& p) {
                        p.size_m = {1, 0, 1};
                      }),
             Contains("part \"part\": size_m = [1, 0, 1]: must be > 0"));
  CHECK_THAT(error_of("ellipsoid", [](P& p) { p.radii_m.z() = 0; }), Contains("radii_m"));
  CHECK_THAT(error_of("cylinder", [](P& p) { p.radius_m = 0; }), Contains("radius_m is needed"));
  CHECK_THAT(error_of("capsule", [](P& p) { p.to_m = p.from_m; }), Contains("the same point"));
  CHECK_THAT(error_of("box", [](P& p) { p.rounding_m = 0.5; }), Contains("rounding_m = 0.5: must be at most 0.475"));
  CHECK_THAT(error_of("cylinder", [](P& p) { p.rounding_m = 0.48; }), Contains("must be at most 0.475"));
  CHECK_THAT(error_of("box", [](P& p) { p.mass_kg = p.density_kg_m3 = 1; }), Contains("not both"));
  CHECK_THAT(error_of("box", [](P& p) { p.mirror = "xz", p.center_m.z() = 0; }), Contains("lies in the plane z = 0"));
  CHECK_THAT(error_of("capsule", [](P& p) { p.mirror = "x", p.to_m.x() = -1; }), Contains("lies in the plane x = 0"));
  AirframeOptions airframe;
  airframe.step = "/missing.step";
  CHECK_THROWS_WITH(validate(airframe), Contains("/missing.step: cannot read this STEP file"));
}

TEST_CASE("mirror images") {
  AirframeOptions airframe = airframe_of("capsule");
  airframe.part[0].to_m = {2, 3, 5};
  airframe.part[0].mirror = "xz";
  const auto parts = all_parts(airframe);
  REQUIRE(parts.size() == 4);
  CHECK(parts[1].to_m == Vec3(-2, 3, 5));
  CHECK(parts[2].to_m == Vec3(2, 3, -5));
  CHECK(parts[3].to_m == Vec3(-2, 3, -5));
  CHECK(parts[3].from_m == Vec3(-1, 0, -1));
}

TEST_CASE("sizes at points: the smallest of what all want") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-1, 1), size(0.01, 0.2);
  std::vector<Vec3> points;
  std::vector<double> sizes;
  for (int i = 0; i < 500; ++i) {
    points.emplace_back(place(random), place(random), 0.1 * place(random));
    sizes.push_back(size(random));
  }
  const double growth = 0.3;
  const PointSizes field(points, sizes, growth);
  for (int i = 0; i < 200; ++i) {
    const Vec3 p(2 * place(random), 2 * place(random), 2 * place(random));
    double expected = 1e300;
    for (size_t k = 0; k < points.size(); ++k)
      expected = std::min(expected, sizes[k] + growth * std::max(0.0, (p - points[k]).norm() - sizes[k]));
    CHECK(field(p) == Approx(expected).epsilon(1e-14));
  }
  CHECK(PointSizes({Vec3(0, 0, 0)}, {0.1}, 0.5)(Vec3(0, 0, 0.1)) == 0.1);
  CHECK(PointSizes()(Vec3(0, 0, 0)) > 1e300);
}

TEST_CASE("sizes in the wake of a rotor, at the airframe and far away") {
  GeometryOptions g;
  g.refine = 2;
  g.farfield = {Vec3::Zero(), 50, 10};
  RotorOptions r;
  r.blade.count = 2;
  r.blade.radius_m = 1;
  r.blade.r_over_R = {0.2, 1};
  r.blade.c_over_R = {0.15, 0.1};
  r.blade.beta_deg = {20, 8};
  r.zone = {1.2, -0.3, 0.3};
  r.size.wake_m = 0.05;
  complete(r, ".");
  g.rotor.push_back(r);
  const SizeField size(g, PointSizes({Vec3(5, 0, 0)}, {0.02}, 0.3));
  CHECK(size({0, -0.9, 0}) == Approx(0.025));
  CHECK(size({1.1, -1.2, 0}) == Approx(0.025));
  CHECK(size({0, -2.3, 0}) == Approx((0.05 + 0.3) / 2));  // the wake is one radius long
  CHECK(size({5, 0, 0}) == 0.02);
  CHECK(size({0, 49, 0}) == Approx(5));
}
