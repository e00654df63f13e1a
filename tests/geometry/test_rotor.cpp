#include "geometry/rotor.h"

#include <catch2/catch.hpp>
#include <fstream>

#include "../io/scratch.h"
#include "base/errors.h"
#include "geometry/stations.h"

using namespace windhover;
using namespace windhover::geometry;
using Catch::Contains;

namespace {

GeometryOptions geometry_of_one() {
  GeometryOptions g;
  g.farfield.radius_m = 5;
  RotorOptions r;
  r.name = "left";
  r.blade.count = 2;
  r.blade.radius_m = 1;
  r.blade.r_over_R = {0.2, 1};
  r.blade.c_over_R = {0.15, 0.1};
  r.blade.beta_deg = {20, 8};
  r.hub = {0.08, -0.05, 0.05, 0.02};
  r.zone = {1.2, -0.3, 0.3};
  complete(r, ".");
  g.rotor.push_back(r);
  return g;
}

template <class Change>
std::string error_of(Change change) {
  GeometryOptions g = geometry_of_one();
  change(g, g.rotor[0]);
  try {
    validate(g);
  } catch (const UserError& error) {
    return error.what();
  }
  return "no error";
}

std::string error_of_file(const std::string& text) {
  const testing::Scratch scratch;
  std::ofstream(scratch.path / "blade.csv") << text;
  BladeOptions blade;
  blade.stations = "blade.csv";
  try {
    read_stations(blade, scratch.path);
  } catch (const UserError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST_CASE("a rotor that fits is accepted, and its sizes are filled in") {
  const GeometryOptions g = geometry_of_one();
  CHECK_NOTHROW(validate(g));
  CHECK(g.rotor[0].size.tip_m == 0.04);
  CHECK(g.rotor[0].size.zone_m == 0.12);
}

TEST_CASE("what does not fit is refused with the place") {
  using G = GeometryOptions;
  using R = RotorOptions;
  CHECK_THAT(error_of([](G&, R& r) { r.zone.radius_m = 0.9; }), Contains("rotor \"left\": a blade pokes through its zone"));
  CHECK_THAT(error_of([](G&, R& r) { r.zone.to_m = 0.02; r.hub.radius_m = 0; }), Contains("a blade pokes through its zone"));
  CHECK_THAT(error_of([](G&, R& r) { r.hub.radius_m = 0.25; }), Contains("a blade's root is in the hub"));
  CHECK_THAT(error_of([](G&, R& r) { r.hub.to_m = 0.4; }), Contains("the hub pokes through its zone"));
  CHECK_THAT(error_of([](G&, R& r) { r.hub.rounding_m = 0.2; }), Contains("hub.rounding_m = 0.2: must be at most"));
  CHECK_THAT(error_of([](G& g, R&) { g.farfield.radius_m = 1.2; }), Contains("its zone leaves the ball"));
  CHECK_THAT(error_of([](G&, R& r) { r.axis = Vec3::Zero(); }), Contains("has no direction"));
  CHECK_THAT(error_of([](G&, R& r) { r.blade.airfoil = "naca"; }), Contains("neither naca and four digits"));
}

TEST_CASE("sections along a blade: one airfoil or several, on the blade, outwards") {
  const auto error = [](const std::vector<SectionOptions>& sections, const std::string& airfoil = "") {
    return error_of([&](GeometryOptions&, RotorOptions& r) { r.blade.section = sections, r.blade.airfoil = airfoil; });
  };
  CHECK(error({{0.2, "naca4412"}, {1, "naca4406"}}) == "no error");
  CHECK(error({{0.9, "naca4412"}}) == "no error");
  CHECK_THAT(error({{0.2, "naca4412"}}, "naca0012"), Contains("left\": blade: give either airfoil = \"naca0012\" or [[section]]"));
  CHECK_THAT(error({{0.1, "naca4412"}}), Contains("section[0].r_over_R = 0.1: must be on the blade, from 0.2 to 1"));
  CHECK_THAT(error({{0.5, "naca4412"}, {0.5, "naca0012"}}), Contains("section[1].r_over_R = 0.5: must be greater than 0.5"));
  CHECK_THAT(error({{0.5, ""}}), Contains("section[0].airfoil is needed"));
  CHECK_THAT(error({{0.5, "naca4412"}, {1, "e63"}}), Contains("section[1]: e63: airfoil: neither naca and four digits nor a file"));
}

TEST_CASE("files of airfoils are found beside the case, and naca0012 is meant where none is named") {
  const testing::Scratch scratch;
  std::ofstream(scratch.path / "thin.dat") << "title\n";
  RotorOptions r;
  r.blade.section = {{0.5, "thin.dat"}, {1, "naca0012"}};
  complete(r, scratch.path);
  CHECK(r.blade.section[0].airfoil == scratch.path / "thin.dat");
  CHECK(r.blade.section[1].airfoil == "naca0012");
  CHECK(r.blade.airfoil.empty());
  RotorOptions plain;
  complete(plain, scratch.path);
  CHECK(plain.blade.airfoil == "naca0012");
}

TEST_CASE("zones that overlap and names that repeat are refused") {
  const auto with_second = [](const Vec3& center, const std::string& name) {
    return error_of([&](GeometryOptions& g, RotorOptions&) {
      g.rotor.push_back(g.rotor[0]);
      g.rotor[1].center_m = center;
      g.rotor[1].name = name;
    });
  };
  CHECK(with_second({2.5, 0, 0}, "right") == "no error");
  CHECK(with_second({0, 0.65, 0}, "right") == "no error");
  CHECK_THAT(with_second({2.3, 0, 0}, "right"), Contains("its zone overlaps that of rotor \"right\" at ("));
  CHECK_THAT(with_second({2.5, 0, 0}, "left"), Contains("another rotor of this name"));
}

TEST_CASE("stations must fit together") {
  const auto error = [](auto change) { return error_of([&](GeometryOptions&, RotorOptions& r) { change(r.blade); }); };
  CHECK_THAT(error([](BladeOptions& b) { b.r_over_R = {1}; }), Contains("at least two stations"));
  CHECK_THAT(error([](BladeOptions& b) { b.beta_deg.pop_back(); }), Contains("beta_deg: 1 values for 2 stations"));
  CHECK_THAT(error([](BladeOptions& b) { b.r_over_R = {1, 0.2}; }), Contains("r_over_R[1] = 0.2: must be greater"));
  CHECK_THAT(error([](BladeOptions& b) { b.r_over_R = {0.2, 0.9}; }), Contains("the last station must be the tip"));
}

TEST_CASE("station files") {
  const testing::Scratch scratch;
  std::ofstream(scratch.path / "blade.csv") << "# title\nbeta_deg, r_over_R,c_over_R\n20,0.2,0.1\n10, 0.6,0.2\n5,1,0.1\n";
  BladeOptions blade;
  blade.stations = "blade.csv";
  blade.collective_deg = 1;
  read_stations(blade, scratch.path);
  CHECK(blade.r_over_R == std::vector<double>{0.2, 0.6, 1});
  CHECK(blade.beta_deg == std::vector<double>{20, 10, 5});
  CHECK(blade.stations.empty());
  const Stations stations(blade);
  CHECK(stations.chord(0.6) == Approx(0.2));
  CHECK(stations.pitch(1) == Approx(6 * M_PI / 180));
  CHECK(stations.sweep(0.5) == 0);
  CHECK_THAT(error_of_file("r_over_R,chord\n"), Contains("blade.csv:1: unknown column \"chord\""));
  CHECK_THAT(error_of_file("r_over_R,c_over_R\n0.2\n"), Contains("blade.csv:2: 1 values for 2 columns"));
  CHECK_THAT(error_of_file("r_over_R,c_over_R\n0.2,thick\n"), Contains("blade.csv:2: \"thick\" is not a number"));
}

TEST_CASE("splines: through the points, exact for lines, natural at the ends") {
  const Spline line({0, 1, 3}, {1, 2, 4});
  CHECK(line(2) == Approx(3));
  const Spline bump({0, 1, 2}, {0, 1, 0});
  CHECK(bump(1) == Approx(1));
  CHECK(bump(0.5) == Approx(0.6875));  // 1.5 x − 0.5 x³
}
