#include "geometry/blade.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/strips.h"

namespace windhover::geometry {
namespace {

constexpr double kRadians = std::numbers::pi / 180;

double half_thickness(const Airfoil& a) {
  double thickness = 0;
  for (size_t i = 0; i < a.upper.size(); ++i) thickness = std::max(thickness, (a.upper[i] - a.lower[i]).norm() / 2);
  return thickness;
}

}  // namespace

Eigen::Matrix3d rotor_axes(const RotorOptions& rotor) {
  Eigen::Matrix3d axes;
  axes.col(2) = rotor.axis.normalized();
  axes.col(0) = axes.col(2).unitOrthogonal();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

Blades::Blades(const RotorOptions& rotor, double refine) : rotor_(rotor), refine_(refine), stations_(rotor.blade), sections_(rotor.blade) {
  const RotorSizeOptions& size = rotor.size;
  const Airfoil root = sections_.airfoil(stations_.root), end = sections_.airfoil(1);
  chordwise_ = {length_of(root.upper), size.leading_edge, size.trailing_edge, size.chord, size.growth};
  const bool rounded = rotor.blade.tip == "rounded";
  across_ = 2 * std::max(1, static_cast<int>(std::lround(refine * (rounded ? 2 : 1))));
  const double R = rotor.blade.radius_m;
  first_radius_ = R * (stations_.root + (rounded ? half_thickness(root) * stations_.chord(stations_.root) : 0));
  last_radius_ = R * (1 - (rounded ? half_thickness(end) * stations_.chord(1) : 0));
  spanwise_ = {last_radius_ - first_radius_, size.root_m, size.tip_m, size.span_m, size.growth};
  for (int k = 0; k < rotor.blade.count; ++k) to_blade_.push_back(pose(k).inverse());
}

Eigen::Isometry3d Blades::pose(int blade) const {
  using Eigen::AngleAxisd;
  const double angle = rotor_.angle_deg * kRadians + 2 * std::numbers::pi * blade / rotor_.blade.count;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translate(rotor_.center_m);
  pose.rotate(rotor_axes(rotor_));
  pose.rotate(AngleAxisd(angle, Vec3::UnitZ()));
  pose.rotate(AngleAxisd(-rotor_.blade.precone_deg * kRadians, Vec3::UnitY()));
  return pose;
}

BladeSection Blades::local_section(double radius) const {
  const double R = rotor_.blade.radius_m, at = radius / R;
  const double pitch = stations_.pitch(at);
  const Vec3 aft = -rotor_.spin() * Vec3::UnitY();  // the blade moves the other way
  return {.quarter_chord = radius * Vec3::UnitX() + R * (stations_.sweep(at) * aft + stations_.offset(at) * Vec3::UnitZ()),
          .back = std::cos(pitch) * aft - std::sin(pitch) * Vec3::UnitZ(),
          .up = std::sin(pitch) * aft + std::cos(pitch) * Vec3::UnitZ(),
          .chord = stations_.chord(at) * R};
}

double Blades::coarsening(double chord) const {
  const RotorSizeOptions& size = rotor_.size;
  return size.smallest_m == 0 ? 1 : std::min(1.0, std::min(size.leading_edge, size.trailing_edge) * chord / size.smallest_m);
}

Airfoil Blades::points(double radius) const {
  const double at = radius / rotor_.blade.radius_m;
  const Airfoil airfoil = sections_.airfoil(at);
  const auto fractions = chordwise_.fractions(refine_ * coarsening(stations_.chord(at) * rotor_.blade.radius_m));
  return {points_at(airfoil.upper, fractions), points_at(airfoil.lower, fractions)};
}

/// Not much shorter than the cells along the chord; the trailing edge is one cell thick.
int Blades::cells_across(const Airfoil& a, int i) const {
  const double thickness = (a.upper[i] - a.lower[i]).norm(), along = (a.upper[i] - a.upper[i - 1]).norm();
  return i + 1 == static_cast<int>(a.upper.size()) ? 1 : std::clamp(static_cast<int>(std::lround(1.5 * thickness / along)), 1, across_);
}

TriangleSurface Blades::local_surface() const {
  SurfaceBuilder builder(rotor_.spin() > 0);
  const bool is_sharp = rotor_.blade.trailing_edge_thickness == 0;
  std::vector<std::vector<int>> rings;  // over the upper side to the leading edge and back along the lower side
  for (const double f : spanwise_.fractions(refine_)) {
    const double radius = first_radius_ + f * spanwise_.length;
    const BladeSection s = local_section(radius);
    const Airfoil p = points(radius);
    const int n = static_cast<int>(p.upper.size()) - 1;
    auto& ring = rings.emplace_back();
    for (int i = n; i > 0; --i) ring.push_back(builder.add(s.at(p.upper[i])));
    for (int i = 0; i < n; ++i) ring.push_back(builder.add(s.at(p.lower[i])));
    if (!is_sharp) ring.push_back(builder.add(s.at(p.lower[n])));
    ring.push_back(ring.front());
    if (rings.size() > 1) builder.band(rings[rings.size() - 2], ring);
  }
  for (const bool tip : {false, true}) {
    const std::vector<int>& ring = tip ? rings.back() : rings.front();
    const Airfoil p = points(tip ? last_radius_ : first_radius_);
    const int n = static_cast<int>(p.upper.size()) - 1;
    const double bulge = rotor_.blade.tip == "rounded" ? (tip ? 1 : -1) : 0;
    std::vector<int> before = {ring[n]};
    for (int i = 1; i <= n; ++i) {
      const int cells = cells_across(p, i);
      const auto column = i == n && is_sharp ? std::vector<int>{ring[0]} : builder.bridge(ring[n - i], ring[n + i], cells, bulge * Vec3::UnitX());
      tip ? builder.band(before, column) : builder.band(column, before);
      before = column;
    }
  }
  return builder.take();
}

BladeSection Blades::section(int blade, double radius) const {
  const BladeSection s = local_section(radius);
  const Eigen::Isometry3d from_blade = pose(blade);
  return {from_blade * s.quarter_chord, from_blade.linear() * s.back, from_blade.linear() * s.up, s.chord};
}

TriangleSurface Blades::surface(int blade) const {
  TriangleSurface surface = local_surface();
  const Eigen::Isometry3d from_blade = pose(blade);
  for (Vec3& p : surface.points) p = from_blade * p;
  return surface;
}

double Blades::size(const Vec3& point) const {
  double smallest = std::numeric_limits<double>::infinity();
  for (const Eigen::Isometry3d& to_blade : to_blade_) {
    const Vec3 p = to_blade * point;
    const double radius = std::clamp(p.x(), first_radius_, last_radius_);
    const BladeSection s = local_section(radius);
    const double x = std::clamp((p - s.quarter_chord).dot(s.back) / s.chord + 0.25, 0.0, 1.0);
    const double distance = (p - s.at({x, 0})).norm();
    double along = chordwise_.size(x * chordwise_.length);
    if (const double thickness = rotor_.blade.trailing_edge_thickness; thickness > 0)
      along = std::min(along, thickness + rotor_.size.growth * (1 - x));
    const double here = std::sqrt(along * s.chord / coarsening(s.chord) * spanwise_.size(radius - first_radius_));
    smallest = std::min(smallest, here + rotor_.size.growth * distance);
  }
  return smallest;
}

}  // namespace windhover::geometry
