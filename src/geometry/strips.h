// Surfaces built of bands of triangles between rows of points.
#pragma once
#include <vector>

#include "geometry/blade.h"

namespace windhover::geometry {

class SurfaceBuilder {
 public:
  /// mirrored: the points are those of a mirrored surface, so that triangles turn the other way.
  explicit SurfaceBuilder(bool mirrored) : mirrored_(mirrored) {}

  int add(const Vec3& point);

  /// Triangles between two rows that run the same way, each row of any number of points. Seen from outside, b lies to the
  /// left of a. Four points are split along a ridge, not a valley: gmsh would put a flat tetrahedron into the valley.
  void band(const std::vector<int>& a, const std::vector<int>& b);

  /// Points from a to b on a half ellipse that bulges by |a − b|/2 times the vector; with the zero vector on the line.
  std::vector<int> bridge(int a, int b, int cells, const Vec3& bulge);

  TriangleSurface take() { return std::move(surface_); }

 private:
  void triangle(int a, int b, int c);
  bool is_ridge(int a, int b, int c, int d) const;

  bool mirrored_;
  TriangleSurface surface_;
};

}  // namespace windhover::geometry
