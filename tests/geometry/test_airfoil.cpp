#include "geometry/airfoil.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>

#include "../io/scratch.h"
#include "base/errors.h"
#include "geometry/grading.h"

using namespace windhover;
using namespace windhover::geometry;
using Catch::Contains;

namespace {

/// Height of a side at x.
double height(const std::vector<Vec2>& side, double x) {
  size_t i = 1;
  while (side[i].x() < x) ++i;
  const double f = (x - side[i - 1].x()) / (side[i].x() - side[i - 1].x());
  return side[i - 1].y() + f * (side[i].y() - side[i - 1].y());
}

}  // namespace

TEST_CASE("NACA sections have their published ordinates") {
  // Abbott and von Doenhoff, Theory of Wing Sections, appendix III, in percent of the chord
  const Airfoil a = make_airfoil("naca0012", 0.00252);
  const double published[][2] = {{1.25, 1.894}, {10, 4.683}, {30, 6.002}, {60, 4.563}, {95, 0.807}};
  for (const auto& [x, y] : published) {
    CHECK(100 * height(a.upper, x / 100) == Approx(y).margin(2e-3));
    CHECK(100 * height(a.lower, x / 100) == Approx(-y).margin(2e-3));
  }
  const Airfoil b = make_airfoil("naca4412", 0.00252);
  CHECK(100 * height(b.upper, 0.3) == Approx(9.76).margin(0.01));
  CHECK(100 * height(b.lower, 0.3) == Approx(-2.26).margin(0.01));
}

TEST_CASE("the trailing edge has the wanted thickness") {
  for (const char* name : {"naca0012", "naca4409"})
    for (const double thickness : {0.0, 0.02}) {
      const Airfoil a = make_airfoil(name, thickness);
      CHECK((a.upper.back() - a.lower.back()).norm() == Approx(thickness).margin(1e-12));
      CHECK(a.upper.front() == a.lower.front());
    }
}

TEST_CASE("a file of coordinates gives the section that it was made from") {
  const Airfoil a = make_airfoil("naca4412", 0.00252);
  const testing::Scratch scratch;
  const std::string file = scratch.path / "section.dat";
  {
    std::ofstream out(file);
    out << "NACA 4412\n";
    for (size_t i = a.upper.size(); i-- > 0;)
      if (i % 10 == 0) out << a.upper[i].x() << " " << a.upper[i].y() << "\n";
    for (size_t i = 10; i < a.lower.size(); i += 10) out << a.lower[i].x() << " " << a.lower[i].y() << "\n";
  }
  const Airfoil b = make_airfoil(file, 0.00252);
  for (const double x : {0.05, 0.3, 0.7}) {
    CHECK(height(b.upper, x) == Approx(height(a.upper, x)).margin(5e-4));
    CHECK(height(b.lower, x) == Approx(height(a.lower, x)).margin(5e-4));
  }
}

TEST_CASE("a blend has its ends exactly, and halfway the mean of camber and thickness") {
  const Airfoil a = make_airfoil("naca0012", 0.01), b = make_airfoil("naca4408", 0.01);
  CHECK(blend(a, b, 0).upper == a.upper);
  CHECK(blend(a, b, 1).lower == b.lower);
  const Airfoil half = blend(a, b, 0.5), wanted = make_airfoil("naca2410", 0.01);
  for (const double x : {0.01, 0.05, 0.2, 0.4, 0.7, 0.95}) {
    CHECK(height(half.upper, x) == Approx(height(wanted.upper, x)).margin(6e-4));
    CHECK(height(half.lower, x) == Approx(height(wanted.lower, x)).margin(6e-4));
  }
  CHECK(half.upper.front().norm() == 0);
  CHECK((half.upper.back() - half.lower.back()).norm() == Approx(0.01).margin(1e-12));
}

TEST_CASE("a section and its enlargement blend to an enlargement") {
  const Airfoil a = make_airfoil("naca0012", 0.01);
  Airfoil b = a;
  for (auto* side : {&b.upper, &b.lower})
    for (Vec2& p : *side) p *= 2;
  const Airfoil c = blend(a, b, 0.25);
  REQUIRE(c.upper.size() == a.upper.size());
  for (size_t i = 1; i + 1 < c.upper.size(); ++i) {
    CHECK(c.upper[i].y() / 1.25 == Approx(height(a.upper, c.upper[i].x() / 1.25)).margin(1e-10));
    CHECK(c.lower[i].y() / 1.25 == Approx(height(a.lower, c.lower[i].x() / 1.25)).margin(1e-10));
  }
}

TEST_CASE("what is no airfoil is refused") {
  CHECK_THROWS_WITH(make_airfoil("naca00", 0), Contains("neither naca and four digits nor a file"));
  CHECK_THROWS_WITH(make_airfoil("naca0000", 0), Contains("has no thickness"));
  CHECK_THROWS_WITH(make_airfoil("naca4012", 0), Contains("camber and its place"));
  const testing::Scratch scratch;
  const std::string file = scratch.path / "section.dat";
  std::ofstream(file) << "1 0\n0 0\n1 0.1\n";
  CHECK_THROWS_WITH(make_airfoil(file, 0), Contains("at least 5 points on each side"));
}

TEST_CASE("points along a line have the wanted sizes") {
  const Grading grading{1, 0.01, 0.02, 0.1, 0.3};
  const auto f = grading.fractions(1);
  CHECK(f.front() == 0);
  CHECK(f.back() == 1);
  for (size_t i = 1; i < f.size(); ++i) CHECK(f[i] - f[i - 1] == Approx(grading.size((f[i] + f[i - 1]) / 2)).epsilon(0.1));
  CHECK(grading.fractions(3).size() - 1 == Approx(3.0 * (f.size() - 1)).margin(2));
}
