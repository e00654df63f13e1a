#include "mesh/face_geometry.h"

#include <Eigen/Geometry>
#include <array>

#include "mesh/cell_shape.h"

namespace windhover::mesh {
namespace {

Vec3 mean(std::span<const Vec3> points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

/// Calls visit(a, b, c) for each triangle of the fan.
template <class Visit>
void for_each_triangle(std::span<const Vec3> corners, Visit&& visit) {
  if (corners.size() == 3) return visit(corners[0], corners[1], corners[2]);
  const Vec3 apex = mean(corners);
  for (std::size_t i = 0; i < corners.size(); ++i) visit(apex, corners[i], corners[(i + 1) % corners.size()]);
}

}  // namespace

FaceGeometry face_geometry(std::span<const Vec3> corners) {
  FaceGeometry face;
  double total = 0;
  for_each_triangle(corners, [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 area = 0.5 * (b - a).cross(c - a);
    const Vec3 centroid = (a + b + c) / 3;
    face.area += area;
    face.moment += centroid.cross(area);
    face.centroid += area.norm() * centroid;
    total += area.norm();
  });
  face.centroid = total > 0 ? Vec3(face.centroid / total) : mean(corners);
  return face;
}

CellGeometry cell_geometry(CellType type, std::span<const Vec3> corners) {
  const Vec3 apex = mean(corners);
  CellGeometry cell;
  Vec3 first_moment = Vec3::Zero();  // about the apex
  for (const ShapeFace& face : faces_of(type)) {
    std::array<Vec3, 4> p;
    for (int i = 0; i < face.n; ++i) p[i] = corners[face.point[i]];
    for_each_triangle(std::span(p).first(face.n), [&](const Vec3& a, const Vec3& b, const Vec3& c) {
      const double volume = (a - apex).dot((b - apex).cross(c - apex)) / 6;
      cell.volume += volume;
      first_moment += volume * ((a - apex) + (b - apex) + (c - apex)) / 4;
    });
  }
  cell.centroid = cell.volume != 0 ? Vec3(apex + first_moment / cell.volume) : apex;
  return cell;
}

}  // namespace windhover::mesh
