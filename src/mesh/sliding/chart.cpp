#include "mesh/sliding/chart.h"

#include <cmath>

namespace windhover::mesh {

Vec3 Chart::from_local(const Vec3& local) const {
  switch (part) {
    case Part::wall: return {std::atan2(local.y(), local.x()), local.z(), 1};
    case Part::sphere: return local.normalized();
    default: return {local.x(), mirror() * local.y(), 1};
  }
}

Vec3 Chart::to_local(const Vec3& p) const {
  const double radius = surface->radius();
  switch (part) {
    case Part::wall: return {radius * std::cos(p.x()), radius * std::sin(p.x()), p.y()};
    case Part::sphere: return radius * p;
    default: return {p.x(), mirror() * p.y(), surface->disc(part)};
  }
}

namespace {

/// Where the tangents of the rim at a and b meet.
Vec3 tangent_point(const Vec3& a, const Vec3& b) {
  const Eigen::Vector2d p = a.head<2>(), q = b.head<2>();
  const double square = p.squaredNorm();
  const Eigen::Vector2d t = (p + q) * (square / (square + p.dot(q)));
  return {t.x(), t.y(), 1};
}

}  // namespace

ChartFace chart_face(const Chart& chart, std::span<const Vec3> corners, std::span<const bool> arc) {
  ChartFace face;
  face.part = chart.part;
  const int n = static_cast<int>(corners.size());
  std::array<Vec3, 4> v;
  for (int k = 0; k < n; ++k) {
    v[k] = chart.from_local(corners[k]);
    if (chart.part == Part::wall) v[k].x() = v[0].x() + std::remainder(v[k].x() - v[0].x(), 2 * M_PI);
  }
  for (int k = 0; k < n; ++k) {
    const Vec3 &a = v[k], &b = v[(k + 1) % n];
    face.outline.add(a);
    if (arc[k]) {
      face.outline.add(tangent_point(a, b));
      face.rim = true;
    } else {
      face.lines[face.n_lines++] = ChartLine::through(a, b);
    }
  }
  return face;
}

void clip(const Chart& chart, Polygon& polygon, const ChartLine& line) {
  std::array<double, 40> side;
  int n_left = 0;
  for (int k = 0; k < polygon.n; ++k) n_left += (side[k] = line.side(polygon.v[k])) >= 0;
  if (n_left == polygon.n) return;
  Polygon rest;
  for (int k = 0; n_left > 0 && k < polygon.n; ++k) {
    const int before = k > 0 ? k - 1 : polygon.n - 1;
    const Vec3 &from = polygon.v[before], &to = polygon.v[k];
    if ((side[before] < 0) != (side[k] < 0)) {
      const Vec3 cut = from + (side[before] / (side[before] - side[k])) * (to - from);
      rest.add(chart.part == Part::sphere ? cut.normalized() : cut);
    }
    if (side[k] >= 0) rest.add(to);
  }
  polygon.assign(rest);
}

}  // namespace windhover::mesh
