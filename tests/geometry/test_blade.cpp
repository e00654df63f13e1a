#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "geometry/blade.h"

using namespace windhover::geometry;

namespace {

RotorOptions rotor() {
  RotorOptions r;
  r.blade.count = 2;
  r.blade.radius_m = 1;
  r.blade.r_over_R = {0.2, 0.6, 1};
  r.blade.c_over_R = {0.2, 0.25, 0.1};
  r.blade.beta_deg = {25, 15, 5};
  r.blade.airfoil = "naca0012";
  r.size = {0.05, 0.05, 0.2, 0.08, 0.04, 0.08, 0.1, 0.2, 0.2, 0.4};
  return r;
}

/// Each edge belongs to two triangles, once in each direction.
bool is_closed(const TriangleSurface& s) {
  std::map<std::pair<int, int>, int> count;
  for (const auto& t : s.triangles)
    for (int i = 0; i < 3; ++i) ++count[{t[i], t[(i + 1) % 3]}];
  for (const auto& [edge, n] : count)
    if (n != 1 || !count.contains({edge.second, edge.first})) return false;
  return true;
}

double shortest_edge(const TriangleSurface& s) {
  double shortest = 1e300;
  for (const auto& t : s.triangles)
    for (int i = 0; i < 3; ++i) shortest = std::min(shortest, (s.points[t[i]] - s.points[t[(i + 1) % 3]]).norm());
  return shortest;
}

double volume(const TriangleSurface& s) {
  double volume = 0;
  for (const auto& t : s.triangles) volume += s.points[t[0]].dot(s.points[t[1]].cross(s.points[t[2]])) / 6;
  return volume;
}

}  // namespace

TEST_CASE("a blade's surface is closed and faces outwards") {
  for (const char* direction : {"counter_clockwise", "clockwise"})
    for (const char* tip : {"rounded", "flat"})
      for (const double thickness : {0.0, 0.01})
        for (const double refine : {1.0, 2.3}) {
          RotorOptions r = rotor();
          r.direction = direction;
          r.blade.tip = tip;
          r.blade.trailing_edge_thickness = thickness;
          INFO(direction << " " << tip << " " << thickness << " " << refine);
          const TriangleSurface surface = Blades(r, refine).surface(1);
          CHECK(is_closed(surface));
          CHECK(volume(surface) > 0.8 * 0.0823 * 0.035);  // 0.0823 c² t from the section, 0.035 the mean of c² times length
          CHECK(volume(surface) < 1.2 * 0.0823 * 0.035);
        }
}

TEST_CASE("short chords get fewer cells, and the surface stays closed") {
  for (const char* tip : {"rounded", "flat"})
    for (const double thickness : {0.0, 0.01}) {
      RotorOptions r = rotor();
      r.blade.tip = tip;
      r.blade.trailing_edge_thickness = thickness;
      const auto all = Blades(r, 2).surface(0);
      r.size.smallest_m = 0.012;  // 0.05 of the chords are 0.01 to 0.0125, and 0.005 at the tip
      const auto fewer = Blades(r, 2).surface(0);
      CHECK(is_closed(fewer));
      CHECK(fewer.triangles.size() < 0.9 * all.triangles.size());
      CHECK(volume(fewer) == Approx(volume(all)).epsilon(0.02));
      if (thickness == 0) CHECK(shortest_edge(fewer) > 1.3 * shortest_edge(all));  // otherwise it is the trailing edge
    }
}

TEST_CASE("a blade with sections of its own is closed and has their thickness") {
  for (const double thickness : {0.0, 0.01}) {
    RotorOptions r = rotor();
    r.blade.airfoil.clear();
    r.blade.section = {{0.4, "naca0012"}, {0.8, "naca4406"}};
    r.blade.trailing_edge_thickness = thickness;
    const TriangleSurface surface = Blades(r, 2).surface(0);
    CHECK(is_closed(surface));
    RotorOptions thick = r, thin = r;
    thick.blade.section = {{0.2, "naca0012"}};
    thin.blade.section = {{0.2, "naca4406"}};
    CHECK(volume(surface) > 1.1 * volume(Blades(thin, 2).surface(0)));
    CHECK(volume(surface) < 0.9 * volume(Blades(thick, 2).surface(0)));
  }
}

TEST_CASE("the volume of a blade between two sections is that of the mean section") {
  RotorOptions r = rotor();
  r.blade.r_over_R = {0.2, 1};
  r.blade.c_over_R = {0.2, 0.2};
  r.blade.beta_deg = {0, 0};
  r.blade.tip = "flat";
  r.blade.airfoil.clear();
  r.blade.section = {{0.2, "naca0008"}, {1, "naca0016"}};
  r.blade.trailing_edge_thickness = 0.00252;
  CHECK(volume(Blades(r, 6).surface(0)) == Approx(0.08221 * 0.04 * 0.8).epsilon(3e-3));
}

TEST_CASE("the volume of an untwisted blade is the section's area times the span") {
  RotorOptions r = rotor();
  r.blade.r_over_R = {0.2, 1};
  r.blade.c_over_R = {0.2, 0.2};
  r.blade.beta_deg = {0, 0};
  r.blade.tip = "flat";
  r.blade.trailing_edge_thickness = 0.00252;  // as the formula has it
  CHECK(volume(Blades(r, 6).surface(0)) == Approx(0.08221 * 0.04 * 0.8).epsilon(3e-3));
}

TEST_CASE("blades are where the case says") {
  RotorOptions r = rotor();
  r.center_m = {1, 2, 3};
  r.axis = {0, 2, 0};
  r.blade.c_over_R = {0.1, 0.1, 0.1};
  r.blade.beta_deg = {10, 10, 10};
  r.blade.precone_deg = 5;
  const Eigen::Matrix3d axes = rotor_axes(r);
  CHECK(axes.col(2).isApprox(Vec3::UnitY()));
  for (int blade = 0; blade < 2; ++blade) {
    double reach = 0, height = 0;
    for (const Vec3& p : Blades(r, 1).surface(blade).points) {
      const Vec3 local = axes.transpose() * (p - r.center_m);
      if (std::abs(local.x()) > reach) reach = std::abs(local.x()), height = local.z();
      CHECK((blade == 0) == (local.x() > 0));
    }
    CHECK(reach == Approx(std::cos(5 * M_PI / 180)).epsilon(5e-3));
    CHECK(height == Approx(std::sin(5 * M_PI / 180)).margin(0.03));
  }
}

TEST_CASE("the leading edge goes first and, with pitch, up") {
  for (const int spin : {1, -1}) {
    RotorOptions r = rotor();
    r.axis = {0, 0, 1};
    r.direction = spin > 0 ? "counter_clockwise" : "clockwise";
    r.blade.tip = "flat";
    const Eigen::Matrix3d axes = rotor_axes(r);
    Vec3 foremost = Vec3::Zero();
    for (const Vec3& p : Blades(r, 1).surface(0).points) {
      const Vec3 local = axes.transpose() * p;
      if (spin * local.y() > spin * foremost.y()) foremost = local;
    }
    CHECK(spin * foremost.y() > 0.03);
    CHECK(foremost.z() > 0);
  }
}

TEST_CASE("sizes beside a blade are small at its edges and grow with the distance") {
  const RotorOptions r = rotor();
  const Blades blades(r, 1);
  const Vec3 on = rotor_axes(r) * Vec3(0.6, 0, 0);
  CHECK(blades.size(on) < 0.08);
  CHECK(blades.size(on + Vec3(0, 0.5, 0)) == Approx(blades.size(on) + 0.4 * 0.5).epsilon(0.15));
}
