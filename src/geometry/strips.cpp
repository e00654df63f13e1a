#include "geometry/strips.h"

#include <cmath>
#include <numbers>

namespace windhover::geometry {

int SurfaceBuilder::add(const Vec3& point) {
  surface_.points.push_back(point);
  return static_cast<int>(surface_.points.size()) - 1;
}

void SurfaceBuilder::triangle(int a, int b, int c) {
  if (mirrored_) std::swap(b, c);
  surface_.triangles.push_back({a, b, c});
}

/// The first three, counter-clockwise seen from outside, have the fourth below their plane.
bool SurfaceBuilder::is_ridge(int a, int b, int c, int d) const {
  const auto& p = surface_.points;
  const double height = (p[b] - p[a]).cross(p[c] - p[a]).dot(p[d] - p[a]);
  return mirrored_ ? height > 0 : height < 0;
}

void SurfaceBuilder::band(const std::vector<int>& a, const std::vector<int>& b) {
  size_t i = 0, j = 0;
  const size_t last_a = a.size() - 1, last_b = b.size() - 1;
  while (i < last_a || j < last_b) {
    bool step_a = j == last_b;
    if (i < last_a && j < last_b) {
      // rows of equal length advance together, others in proportion to their lengths
      const double ahead = (i + 1.0) / last_a - (j + 1.0) / last_b;
      step_a = last_a != last_b ? ahead <= 0 : i == j ? is_ridge(a[i], a[i + 1], b[j], b[j + 1]) : i < j;
    }
    if (step_a) {
      triangle(a[i], a[i + 1], b[j]);
      ++i;
    } else {
      triangle(a[i], b[j + 1], b[j]);
      ++j;
    }
  }
}

std::vector<int> SurfaceBuilder::bridge(int a, int b, int cells, const Vec3& bulge) {
  const Vec3 middle = (surface_.points[a] + surface_.points[b]) / 2, half = (surface_.points[a] - surface_.points[b]) / 2;
  std::vector<int> row{a};
  for (int k = 1; k < cells; ++k) {
    const double angle = std::numbers::pi * k / cells;
    const double along = bulge.isZero() ? 1 - 2.0 * k / cells : std::cos(angle);
    row.push_back(add(middle + along * half + std::sin(angle) * half.norm() * bulge));
  }
  row.push_back(b);
  return row;
}

}  // namespace windhover::geometry
