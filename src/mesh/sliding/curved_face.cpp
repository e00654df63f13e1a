#include "mesh/sliding/curved_face.h"

#include <cmath>

namespace windhover::mesh {
namespace {

/// Gauss–Legendre points on [0, 1].
struct Gauss {
  static constexpr int n = 12;
  double t[n], w[n];
  Gauss() {
    for (int i = 0; i < n; ++i) {
      double x = std::cos(M_PI * (i + 0.75) / (n + 0.5)), slope = 0;
      for (int step = 0; step < 10; ++step) {  // Newton's method for the Legendre polynomial's root
        double p = 1, before = 0;
        for (int k = 1; k <= n; ++k) {
          const double next = ((2 * k - 1) * x * p - (k - 1) * before) / k;
          before = p, p = next;
        }
        slope = n * (x * p - before) / (x * x - 1);
        x -= p / slope;
      }
      t[i] = (1 - x) / 2;
      w[i] = 1 / ((1 - x * x) * slope * slope);
    }
  }
};
const Gauss gauss;

/// Calls visit(weight, r, dr/dt) at the Gauss points of a curved edge.
template <class Visit>
void visit_curve(const RevolutionSurface& surface, const Vec3& from, const Vec3& to, Visit&& visit) {
  const Vec3 a = surface.to_local(from), b = surface.to_local(to);
  const double radius = surface.radius();
  if (surface.is_sphere()) {
    const Vec3 e = a.normalized(), normal = e.cross(b - a);
    const double angle = std::atan2(normal.norm(), e.dot(b));
    const Vec3 f = normal.cross(e).normalized();
    for (int i = 0; i < Gauss::n; ++i) {
      const double c = std::cos(angle * gauss.t[i]), s = std::sin(angle * gauss.t[i]);
      visit(gauss.w[i], surface.to_parent(radius * (c * e + s * f)),
            surface.axes() * (radius * angle * (c * f - s * e)));
    }
    return;
  }
  const double start = std::atan2(a.y(), a.x());
  const double angle = std::remainder(std::atan2(b.y(), b.x()) - start, 2 * M_PI);
  for (int i = 0; i < Gauss::n; ++i) {
    const double c = std::cos(start + angle * gauss.t[i]), s = std::sin(start + angle * gauss.t[i]);
    visit(gauss.w[i], surface.to_parent({radius * c, radius * s, a.z() + gauss.t[i] * (b.z() - a.z())}),
          surface.axes() * Vec3(-radius * angle * s, radius * angle * c, b.z() - a.z()));
  }
}

template <class Visit>
void visit_line(const Vec3& from, const Vec3& to, Visit&& visit) {
  for (int i = 0; i < Gauss::n; ++i) visit(gauss.w[i], from + gauss.t[i] * (to - from), to - from);
}

Vec3 mean(std::span<const Vec3> points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

}  // namespace

SurfaceSums cone_sums(std::span<const Vec3> corners, std::span<const RevolutionSurface* const> curve, const Vec3& o) {
  SurfaceSums sums;
  const Vec3 apex = mean(corners), q = apex - o;
  // points apex + s g(t): n dA = s g × g' ds dt, and the integrals over s are known
  const auto add = [&](double weight, const Vec3& r, const Vec3& slope) {
    const Vec3 g = r - apex, normal = weight * g.cross(slope);
    const double size = normal.norm();
    sums.size += size / 2;
    sums.area += normal / 2;
    sums.moment += (apex / 2 + g / 3).cross(normal);
    sums.centroid += size * (apex / 2 + g / 3);
    sums.volume += q.dot(normal) / 6;
    sums.first += (q.squaredNorm() / 2 + q.dot(g) * 2 / 3 + g.squaredNorm() / 4) / 2 * normal;
  };
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec3 &from = corners[k], &to = corners[(k + 1) % corners.size()];
    curve[k] ? visit_curve(*curve[k], from, to, add) : visit_line(from, to, add);
  }
  return sums;
}

Vec3 patch_first(const Chart& chart, std::span<const Vec3> outline, const Vec3& o) {
  const RevolutionSurface& surface = *chart.surface;
  const Vec3 apex = mean(outline), local_o = surface.to_local(o);
  const double radius = surface.radius();
  const bool flat = chart.part == Part::wall;
  Vec3 first = Vec3::Zero();
  const auto add = [&](double weight, const Vec3& edge_point, const Vec3& slope) {
    const Vec3 g = edge_point - apex;
    const double density =
        weight * apex.dot(g.cross(slope));  // of the chart's area, or of the flat facet's solid angle
    for (int i = 0; i < Gauss::n; ++i) {
      const Vec3 p = apex + gauss.t[i] * g;
      const double s = gauss.w[i] * gauss.t[i] * density;
      const Vec3 r = chart.to_local(flat ? p : p.normalized());
      const Vec3 n = flat ? Vec3(s * r.x(), s * r.y(), 0) : Vec3(radius * s / std::pow(p.norm(), 3) * r);
      first += (r - local_o).squaredNorm() / 2 * n;
    }
  };
  for (std::size_t k = 0; k < outline.size(); ++k) visit_line(outline[k], outline[(k + 1) % outline.size()], add);
  return surface.axes() * first;
}

}  // namespace windhover::mesh
