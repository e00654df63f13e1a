#include <catch2/catch.hpp>
#include <set>

#include "mesh/mesh.h"
#include "mesh_fixture.h"
#include "mesh_sums.h"

using namespace windhover;
using namespace windhover::mesh;

TEST_CASE("a doubly periodic plane of hexahedra looks like an infinite lattice") {
  const int nx = 6, ny = 5;
  const std::string file = make_mesh("box", {{"nx", nx}, {"ny", ny}, {"nz", 1}, {"lx", 1.2}, {"ly", 0.5}, {"px", 1}, {"py", 1}});
  const Mesh mesh = read_mesh(file, 1, PETSC_COMM_WORLD);
  const Vec3 cell(1.2 / nx, 0.5 / ny, 1);
  REQUIRE(mesh.patches.size() == 2);
  CHECK(mesh.patches[0].name == "zmin");
  CHECK(mesh.patches[1].name == "zmax");
  const FaceCount count = count_faces(mesh);
  CHECK(count.interior == 2 * nx * ny);
  CHECK(count.boundary == 2 * nx * ny);
  CHECK(owned_volume(mesh) == Approx(0.6));
  for_each_face(mesh, [&](const FaceBlock& block, int lane, bool boundary) {
    const Vec3 A = area_of(block, lane);
    const Vec3 n = A.normalized();
    int axis = 0;
    n.cwiseAbs().maxCoeff(&axis);
    CHECK(A.norm() == Approx(cell.prod() / cell[axis]));
    for (int side = 0; side < (boundary ? 1 : 2); ++side)
      CHECK((arm_of(block, lane, side) - (side == 0 ? 0.5 : -0.5) * cell[axis] * n).norm() < 1e-14);
  });
  CHECK(opening(mesh).area < 3e-15);
}

TEST_CASE("points and nodes of a periodic mesh") {
  const Mesh mesh = read_mesh(make_mesh("box", {{"nz", 1}, {"px", 1}, {"py", 1}}), 1, PETSC_COMM_SELF);
  CHECK(mesh.n_nodes == 6 * 5 * 2);
  CHECK(mesh.point.size() == 7 * 6 * 2);
  for (Index i = 0; i < mesh.n_cells; ++i)
    for (Index k = mesh.cell_point_start[i]; k < mesh.cell_point_start[i + 1]; ++k)
      CHECK((mesh.point[mesh.cell_point[k]] - mesh.centroid[i]).norm() < 0.6);  // beside its own cell
}

TEST_CASE("a cube of tetrahedra, periodic in all directions") {
  const Mesh mesh = read_mesh(make_mesh("periodic_cube"), 1, PETSC_COMM_WORLD);
  CHECK(mesh.patches.empty());
  CHECK(owned_volume(mesh) == Approx(1));
  CHECK(opening(mesh).area < 3e-15);
  // the arms meet at the face: the line between neighbours closes around the lattice
  double worst = 0;
  for_each_face(mesh, [&](const FaceBlock& block, int lane, bool) {
    const Vec3 between = mesh.centroid[block.cell[1][lane]] - mesh.centroid[block.cell[0][lane]];
    const Vec3 period = arm_of(block, lane, 0) - arm_of(block, lane, 1) - between;
    for (int d = 0; d < 3; ++d) worst = std::max(worst, std::abs(period[d] - std::round(period[d])));
    worst = std::max(worst, arm_of(block, lane, 0).norm() > 0.5 ? 1.0 : 0.0);
  });
  CHECK(worst < 1e-13);
  const Mesh alone = read_mesh(make_mesh("periodic_cube"), 1, PETSC_COMM_SELF);
  CHECK(alone.hash == mesh.hash);
  CHECK(count_faces(alone).interior == count_faces(mesh).interior);
}
