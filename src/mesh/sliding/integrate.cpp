// Exact integrals over polygons of the charts, by their boundaries. All are taken relative to a point of the polygon,
// so that small pieces are as exact, relative to their own size, as large ones.
#include <algorithm>
#include <array>
#include <cmath>

#include "mesh/sliding/chart.h"

namespace windhover::mesh {
namespace {

using Vec2 = Eigen::Vector2d;

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// x − sin x without cancellation.
double arc_excess(double x) {
  double term = x * x * x / 6, sum = term;
  for (int k = 4; std::abs(term) > 1e-18 * std::abs(sum); k += 2) sum += term *= -x * x / (k * (k + 1));
  return sum;
}

/// Area and first moments about an origin of a plane region, summed along its boundary of lines and arcs of the rim.
class PlaneSum {
 public:
  PlaneSum(const Vec2& origin, double radius) : origin_(origin), radius_(radius) {}

  void add_line(const Vec2& from, const Vec2& to) {
    const Vec2 a = from - origin_, b = to - origin_;
    const double twice = cross(a, b);
    area_ += twice / 2;
    first_ += twice / 6 * (a + b);
  }
  /// Both ends on the rim: its chord, and the segment between chord and arc.
  void add_arc(const Vec2& from, const Vec2& to) {
    add_line(from, to);
    const double angle = std::atan2(cross(from, to), from.dot(to));
    const Vec2 middle = (from + to).normalized();
    const double segment = radius_ * radius_ / 2 * arc_excess(angle);
    const double lever = 2.0 / 3 * std::pow(radius_ * std::sin(angle / 2), 3);
    area_ += segment;
    first_ += lever * middle - segment * origin_;
  }
  /// The part of an edge outside the rim is moved towards the centre onto the rim: the boundary stays closed.
  void add_clipped(const Vec2& from, const Vec2& to) {
    const Vec2 along = to - from;
    const double a = along.squaredNorm(), b = from.dot(along), c = from.squaredNorm() - radius_ * radius_;
    const double root = std::sqrt(std::max(b * b - a * c, 0.0));
    const double enter = std::clamp((-b - root) / a, 0.0, 1.0), leave = std::clamp((-b + root) / a, 0.0, 1.0);
    const auto on_rim = [&](const Vec2& p) { return Vec2(radius_ * p.normalized()); };
    if (!(a > 0) || !(leave > enter)) return add_arc(on_rim(from), on_rim(to));
    const Vec2 in = enter > 0 ? on_rim(from + enter * along) : from;
    const Vec2 out = leave < 1 ? on_rim(from + leave * along) : to;
    if (enter > 0) add_arc(on_rim(from), in);
    add_line(in, out);
    if (leave < 1) add_arc(out, on_rim(to));
  }

  double area() const { return area_; }
  Vec2 first() const { return first_ + area_ * origin_; }
  Vec2 centroid() const { return area_ > 0 ? Vec2(origin_ + first_ / area_) : origin_; }

 private:
  Vec2 origin_;
  double radius_;
  double area_ = 0;
  Vec2 first_ = Vec2::Zero();
};

PlaneSum plane_sum(std::span<const Vec3> polygon, double radius, bool rim) {
  PlaneSum sum(polygon[0].head<2>(), radius);
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec2 from = polygon[k].head<2>(), to = polygon[(k + 1) % polygon.size()].head<2>();
    rim ? sum.add_clipped(from, to) : sum.add_line(from, to);
  }
  return sum;
}

/// Normal ±e_z, r = (x, y, z): r × n = ±(y, −x, 0).
PatchIntegrals disc_integrals(const Chart& chart, std::span<const Vec3> polygon, bool rim) {
  const PlaneSum sum = plane_sum(polygon, chart.surface->radius(), rim);
  const double normal = chart.mirror();
  const Vec2 first = sum.first();
  const Vec2 centroid = sum.centroid();
  return {.size = sum.area(),
          .area = {0, 0, normal * sum.area()},
          .moment = {first.y(), -normal * first.x(), 0},  // y is mirrored at the bottom
          .centroid = chart.to_local({centroid.x(), centroid.y(), 1})};
}

/// Means over an edge of angle 2h, with s from -1 to 1: of cos(hs), s sin(hs), s² cos(hs).
struct EdgeMeans {
  double c0 = 0, s1 = 0, c2 = 0;
  explicit EdgeMeans(double h) {
    double term = 1;  // h^2k / (2k)!
    for (int k = 0; std::abs(term) > 1e-18; ++k) {
      c0 += term * inverse[2 * k + 1];
      c2 += term * inverse[2 * k + 3];
      s1 += term * h * inverse[2 * k + 1] * inverse[2 * k + 3];
      term *= -h * h * inverse[2 * k + 1] * inverse[2 * k + 2];
    }
  }

 private:
  static constexpr auto inverse = [] {  // enough for 2h = 2π
    std::array<double, 64> a{};
    for (int i = 1; i < 64; ++i) a[i] = 1.0 / i;
    return a;
  }();
};

/// Green's theorem in (angle, z): ∫∫ f(angle) z^k R = −∮ f z^(k+1) / (k+1) R dangle. With n = e_r: ∫ n dA, and
/// r × n = z e_angle.
PatchIntegrals wall_integrals(const Chart& chart, std::span<const Vec3> polygon) {
  const double z_ref = polygon[0].y(), radius = chart.surface->radius();
  Vec2 area = Vec2::Zero(), moment = Vec2::Zero();
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3 &from = polygon[k], &to = polygon[(k + 1) % polygon.size()];
    const double angle = (from.x() + to.x()) / 2, h = (to.x() - from.x()) / 2;
    const double z = (from.y() + to.y()) / 2 - z_ref, d = (to.y() - from.y()) / 2;
    const Vec2 radial(std::cos(angle), std::sin(angle)), tangent(-radial.y(), radial.x());
    const EdgeMeans mean(h);
    area -= 2 * h * (z * mean.c0 * radial + d * mean.s1 * tangent);
    moment -= h * ((z * z * mean.c0 + d * d * mean.c2) * tangent - 2 * z * d * mean.s1 * radial);
  }
  area *= radius;
  moment = radius * moment + z_ref * Vec2(-area.y(), area.x());
  const PlaneSum plane = plane_sum(polygon, radius, false);
  const Vec2 centroid = plane.centroid();
  return {.size = radius * plane.area(),
          .area = {area.x(), area.y(), 0},
          .moment = {moment.x(), moment.y(), 0},
          .centroid = chart.to_local({centroid.x(), centroid.y(), 1})};
}

/// n = r / R: the moment about the centre vanishes, and ∫ r dA = R ∫ n dA.
PatchIntegrals sphere_integrals(const Chart& chart, std::span<const Vec3> polygon) {
  Vec3 area = Vec3::Zero();
  double solid_angle = 0;
  const Vec3& o = polygon[0];
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    const Vec3 normal = a.cross(b - a), fan = (a - o).cross(b - o);
    const double sine = normal.norm();
    area += fan / 2;
    if (sine > 0) area += arc_excess(std::atan2(sine, a.dot(b))) / (2 * sine) * normal;
    solid_angle += 2 * std::atan2(o.dot(fan), 1 + o.dot(a) + a.dot(b) + b.dot(o));
  }
  const double radius = chart.surface->radius(), length = area.norm();
  return {.size = radius * radius * solid_angle,
          .area = radius * radius * area,
          .moment = Vec3::Zero(),
          .centroid = radius * (length > 0 ? Vec3(area / length) : o)};
}

}  // namespace

PatchIntegrals integrate(const Chart& chart, std::span<const Vec3> polygon, bool rim) {
  if (polygon.size() < 3) return {};
  switch (chart.part) {
    case Part::wall: return wall_integrals(chart, polygon);
    case Part::sphere: return sphere_integrals(chart, polygon);
    default: return disc_integrals(chart, polygon, rim);
  }
}

}  // namespace windhover::mesh
