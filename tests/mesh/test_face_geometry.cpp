#include "mesh/face_geometry.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <vector>

#include "mesh/cell_shape.h"

using namespace windhover::mesh;

TEST_CASE("a flat face: area, moment and centroid by hand") {
  const std::vector<Vec3> square{{1, 0, 2}, {3, 0, 2}, {3, 1, 2}, {1, 1, 2}};
  const FaceGeometry face = face_geometry(square);
  CHECK((face.area - Vec3(0, 0, 2)).norm() < 1e-15);
  CHECK((face.centroid - Vec3(2, 0.5, 2)).norm() < 1e-15);
  CHECK((face.moment - face.centroid.cross(face.area)).norm() < 1e-15);
}

TEST_CASE("the area of any face is that of its edge") {
  const std::vector<Vec3> warped{{0, 0, 0.2}, {1, 0.1, -0.1}, {1.2, 1, 0.3}, {-0.1, 0.9, 0}};
  Vec3 around = Vec3::Zero();
  for (int i = 0; i < 4; ++i) around += 0.5 * warped[i].cross(warped[(i + 1) % 4]);
  CHECK((face_geometry(warped).area - around).norm() < 1e-15);
}

TEST_CASE("a face turned over is its negative at the same place") {
  const std::vector<Vec3> face{{0, 0, 0.2}, {1, 0.1, -0.1}, {1.2, 1, 0.3}, {-0.1, 0.9, 0}};
  const std::vector<Vec3> turned(face.rbegin(), face.rend());
  const FaceGeometry a = face_geometry(face), b = face_geometry(turned);
  CHECK((a.area + b.area).norm() < 1e-15);
  CHECK((a.moment + b.moment).norm() < 1e-15);
  CHECK((a.centroid - b.centroid).norm() < 1e-15);
}

TEST_CASE("cells of each type: volume and centroid of the unit shapes") {
  const Vec3 o(0, 0, 0), x(1, 0, 0), y(0, 1, 0), z(0, 0, 1), up(0, 0, 1);
  const std::vector<Vec3> tetrahedron{o, x, y, z}, pyramid{o, x, x + y, y, z}, prism{o, y, x, o + up, y + up, x + up},
      hexahedron{o, x, x + y, y, o + up, x + up, x + y + up, y + up};
  const auto check = [](CellType type, const std::vector<Vec3>& corners, double volume, const Vec3& centroid) {
    const CellGeometry cell = cell_geometry(type, corners);
    CHECK(cell.volume == Approx(volume));
    CHECK((cell.centroid - centroid).norm() < 1e-15);
  };
  check(CellType::tetrahedron, tetrahedron, 1.0 / 6, Vec3(0.25, 0.25, 0.25));
  check(CellType::pyramid, pyramid, 1.0 / 3, Vec3(0.375, 0.375, 0.25));
  check(CellType::prism, prism, 0.5, Vec3(1.0 / 3, 1.0 / 3, 0.5));
  check(CellType::hexahedron, hexahedron, 1, Vec3(0.5, 0.5, 0.5));
}

TEST_CASE("an inverted cell has negative volume") {
  const std::vector<Vec3> corners{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}};
  CHECK(cell_geometry(CellType::tetrahedron, corners).volume == Approx(-1.0 / 6));
}

TEST_CASE("volume is that of the divergence theorem over the same faces") {
  std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  for (std::size_t i = 0; i < corners.size(); ++i) corners[i] += 0.2 * Vec3(std::sin(3.0 * i), std::cos(5.0 * i), std::sin(7.0 * i));
  // the flux of r through a triangle is its centroid times its area vector: seen from one corner of the fan's apex
  double volume = 0;
  for (const ShapeFace& face : faces_of(CellType::hexahedron)) {
    Vec3 apex = Vec3::Zero();
    for (int i = 0; i < 4; ++i) apex += corners[face.point[i]] / 4;
    for (int i = 0; i < 4; ++i) volume += apex.dot(corners[face.point[i]].cross(corners[face.point[(i + 1) % 4]])) / 6;
  }
  CHECK(cell_geometry(CellType::hexahedron, corners).volume == Approx(volume).epsilon(1e-14));
}
