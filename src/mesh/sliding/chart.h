// Faces on Γ in coordinates in which their edges are straight, and exact integrals over polygons there.
#pragma once
#include <algorithm>
#include <array>
#include <cassert>
#include <span>

#include "mesh/sliding/surface.h"

namespace windhover::mesh {

/// The chart of a part. Wall: (angle, z, 1); discs: (x, y, 1) as seen from outside, so mirrored at the bottom; sphere: unit
/// vectors, whose "straight" edges are great circles. In all of them det(a, b, p) > 0 left of the edge from a to b.
struct Chart {
  const RevolutionSurface* surface;
  Part part;

  Vec3 from_local(const Vec3& local) const;
  Vec3 to_local(const Vec3& p) const;
  double mirror() const { return part == Part::bottom ? -1 : 1; }
};

/// Corners in a chart, counter-clockwise seen from outside.
template <int capacity>
struct Corners {
  int n = 0;
  std::array<Vec3, capacity> v;
  void add(const Vec3& p) {
    assert(n < capacity);
    v[n++] = p;
  }
  void assign(std::span<const Vec3> points) {
    assert(points.size() <= capacity);
    std::copy(points.begin(), points.end(), v.begin());
    n = static_cast<int>(points.size());
  }
  operator std::span<const Vec3>() const { return std::span(v).first(n); }
};
using Outline = Corners<8>;   // a quadrilateral with four arcs
using Polygon = Corners<40>;  // an outline clipped by four lines, each of which adds a half at most

/// A line of a chart: points p with det(from, to, p) >= 0 are on its left.
struct ChartLine {
  Vec3 from, normal;
  static ChartLine through(const Vec3& from, const Vec3& to) { return {from, from.cross(to - from)}; }
  double side(const Vec3& p) const { return normal.dot(p - from); }
};

/// A face is its outline, cut by the rim where it has arcs: there the outline runs along the rim's tangents, outside the disc.
struct ChartFace {
  Part part = Part::wall;
  bool rim = false;
  Outline outline;
  int n_lines = 0;
  std::array<ChartLine, 4> lines;  ///< the straight edges
};

/// The corners in Γ's axes, counter-clockwise from outside; arc[k]: the edge from corner k to the next one follows the rim.
ChartFace chart_face(const Chart& chart, std::span<const Vec3> corners, std::span<const bool> arc);

/// Over a part of Γ, in Γ's axes and about its origin, the normal outwards.
struct PatchIntegrals {
  double size = 0;               ///< ∫ dA
  Vec3 area = Vec3::Zero();      ///< ∫ n dA
  Vec3 moment = Vec3::Zero();    ///< ∫ r × n dA
  Vec3 centroid = Vec3::Zero();  ///< moved onto Γ
};

/// rim: only what lies inside the rim counts.
PatchIntegrals integrate(const Chart& chart, std::span<const Vec3> polygon, bool rim);

/// Cuts away what is right of the line.
void clip(const Chart& chart, Polygon& polygon, const ChartLine& line);

}  // namespace windhover::mesh
