#include <catch2/catch.hpp>

#include "mesh/mesh.h"
#include "mesh_fixture.h"

using namespace windhover;
using namespace windhover::mesh;

namespace {

template <class T>
T sum(T value, MPI_Comm comm) {
  double local = static_cast<double>(value), total = 0;
  MPI_Allreduce(&local, &total, 1, MPI_DOUBLE, MPI_SUM, comm);
  return static_cast<T>(total);
}

double owned_volume(const Mesh& mesh) {
  double volume = 0;
  for (Index i = 0; i < mesh.n_owned; ++i) volume += mesh.volume[i];
  return sum(volume, mesh.comm);
}

/// Largest |Σ A| and |Σ M| over the owned cells, relative to the cells' surface (times the distance from the origin).
struct Opening {
  double area = 0, moment = 0;
};
Opening opening(const Mesh& mesh) {
  std::vector<Vec3> area(mesh.n_cells, Vec3::Zero()), moment = area;
  std::vector<double> surface(mesh.n_cells, 0);
  const auto add = [&](const FaceBlock& block, bool boundary) {
    for (int lane = 0; lane < block.count; ++lane) {
      const Vec3 A(block.area[0][lane], block.area[1][lane], block.area[2][lane]);
      const Vec3 M(block.moment[0][lane], block.moment[1][lane], block.moment[2][lane]);
      for (int side = 0; side < (boundary ? 1 : 2); ++side) {
        const double sign = side == 0 ? 1 : -1;
        area[block.cell[side][lane]] += sign * A;
        moment[block.cell[side][lane]] += sign * M;
        surface[block.cell[side][lane]] += A.norm();
      }
    }
  };
  for (const FaceBlock& block : mesh.faces) add(block, false);
  for (const Patch& patch : mesh.patches)
    for (const FaceBlock& block : patch.blocks) add(block, true);
  Opening worst;
  for (Index i = 0; i < mesh.n_owned; ++i) {
    worst.area = std::max(worst.area, area[i].norm() / surface[i]);
    worst.moment = std::max(worst.moment, moment[i].norm() / surface[i]);
  }
  return worst;
}

void check_box(const Mesh& mesh, double volume) {
  CHECK(owned_volume(mesh) == Approx(volume).epsilon(1e-13));
  CHECK(sum(mesh.n_owned, mesh.comm) == mesh.n_global);
  const Opening worst = opening(mesh);
  CHECK(worst.area < 3e-15);
  CHECK(worst.moment < 3e-15);
}

}  // namespace

TEST_CASE("boxes of each cell type close and fill their volume") {
  SECTION("tetrahedra") { check_box(read_mesh(make_mesh("cube"), 1, PETSC_COMM_WORLD), 1); }
  SECTION("hexahedra") { check_box(read_mesh(make_mesh("box", {{"lx", 2}}), 0.5, PETSC_COMM_WORLD), 0.25); }
  SECTION("prisms, one cell thick") { check_box(read_mesh(make_mesh("prisms"), 1, PETSC_COMM_WORLD), 0.1); }
  SECTION("prisms") { check_box(read_mesh(make_mesh("prisms", {{"nz", 4}, {"lz", 1}}), 1, PETSC_COMM_WORLD), 1); }
}
