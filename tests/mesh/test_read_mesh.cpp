#include <catch2/catch.hpp>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "mesh/mesh.h"
#include "mesh_fixture.h"
#include "mesh_sums.h"

using namespace windhover;
using namespace windhover::mesh;

namespace {

void check_closed(const Mesh& mesh) {
  const Opening worst = opening(mesh);
  CHECK(worst.area < 3e-15);
  CHECK(worst.moment < 1e-14);
}

void check_box(const std::string& file, double scale, double volume) {
  const Mesh mesh = read_mesh(file, scale, PETSC_COMM_WORLD);
  CHECK(owned_volume(mesh) == Approx(volume).epsilon(1e-13));
  CHECK(total(mesh.n_owned, mesh.comm) == mesh.n_global);
  check_closed(mesh);
}

/// A copy of a mesh file (msh 2.2, text) whose nodes are moved along smooth waves: quadrilaterals are no longer flat.
std::string distorted(const std::string& file) {
  const std::string copy = file + ".distorted.msh";
  int rank = 0;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  if (rank == 0 && !std::filesystem::exists(copy)) {
    std::ifstream in(file);
    const std::string part = fmt::format("{}.{}", copy, ::getpid());
    std::ofstream out(part);
    out.precision(17);
    std::string line;
    while (std::getline(in, line) && line != "$Nodes") out << line << '\n';
    int n_nodes = 0, node = 0;
    in >> n_nodes;
    out << "$Nodes\n" << n_nodes;
    for (double x, y, z; n_nodes-- > 0 && in >> node >> x >> y >> z;)
      out << '\n' << node << ' ' << x + 0.06 * std::sin(4 * y + 3 * z) << ' ' << y + 0.05 * std::sin(5 * z + 2 * x) << ' '
          << z + 0.07 * std::sin(5 * x * y);
    out << in.rdbuf();
    out.close();
    std::filesystem::rename(part, copy);
  }
  MPI_Barrier(PETSC_COMM_WORLD);
  return copy;
}

}  // namespace

TEST_CASE("boxes of each cell type close and fill their volume") {
  SECTION("tetrahedra") { check_box(make_mesh("cube"), 1, 1); }
  SECTION("tetrahedra, binary file") { check_box(make_mesh("cube", {}, "-bin"), 1, 1); }
  SECTION("tetrahedra, old format") { check_box(make_mesh("cube", {}, "-format msh22"), 1, 1); }
  SECTION("hexahedra, scaled") { check_box(make_mesh("box", {{"lx", 2}}), 0.5, 0.25); }
  SECTION("prisms, one cell thick") { check_box(make_mesh("prisms"), 1, 0.1); }
  SECTION("prisms") { check_box(make_mesh("prisms", {{"nz", 4}, {"lz", 1}}), 1, 1); }
  SECTION("mixed") { check_box(make_mesh("mixed"), 1, 3); }
}

TEST_CASE("a distorted mesh of all cell types closes") {
  const Mesh mesh = read_mesh(distorted(make_mesh("mixed", {}, "-format msh22")), 1, PETSC_COMM_WORLD);
  std::set<CellType> types(mesh.type.begin(), mesh.type.end());
  if (mesh.n_owned == mesh.n_global) CHECK(types.size() == 4);
  check_closed(mesh);
}

TEST_CASE("zones and patches are named and the same on all ranks") {
  const Mesh mesh = read_mesh(make_mesh("cube"), 1, PETSC_COMM_WORLD);
  REQUIRE(mesh.zones.size() == 1);
  CHECK(mesh.zones[0].name == "air");
  REQUIRE(mesh.patches.size() == 2);
  CHECK(mesh.patches[0].name == "wall");
  CHECK(mesh.patches[1].name == "far");
  Vec3 wall = Vec3::Zero();
  for (const FaceBlock& block : mesh.patches[0].blocks)
    for (int lane = 0; lane < block.count; ++lane) wall += area_of(block, lane);
  CHECK(total(wall.x(), mesh.comm) == Approx(-1));
  CHECK(total(wall.y(), mesh.comm) == Approx(0).margin(1e-14));
}

TEST_CASE("the whole does not depend on the number of ranks") {
  for (const char* name : {"cube", "mixed"}) {
    const std::string file = make_mesh(name);
    const Mesh alone = read_mesh(file, 1, PETSC_COMM_SELF), parts = read_mesh(file, 1, PETSC_COMM_WORLD);
    CHECK(alone.hash == parts.hash);
    CHECK(alone.n_global == parts.n_global);
    CHECK(alone.n_owned == alone.n_cells);
    const FaceCount a = count_faces(alone), p = count_faces(parts);
    CHECK(a.interior == p.interior);
    CHECK(a.boundary == p.boundary);
    // the same cell has the same shape
    std::vector<Index> by_file(alone.n_cells);
    for (Index i = 0; i < alone.n_cells; ++i) by_file[alone.file_cell[i]] = i;
    for (Index i = 0; i < parts.n_owned; ++i) {
      const Index j = by_file[parts.file_cell[i]];
      REQUIRE(parts.volume[i] == alone.volume[j]);
      REQUIRE(parts.centroid[i] == alone.centroid[j]);
      REQUIRE(parts.type[i] == alone.type[j]);
    }
  }
}

TEST_CASE("the hash sees a moved node") {
  const std::string file = make_mesh("mixed", {}, "-format msh22");
  CHECK(read_mesh(file, 1, PETSC_COMM_SELF).hash != read_mesh(distorted(file), 1, PETSC_COMM_SELF).hash);
}

TEST_CASE("padding lanes are harmless") {
  const Mesh mesh = read_mesh(make_mesh("cube"), 1, PETSC_COMM_WORLD);
  for (const FaceBlock& block : mesh.faces)
    for (int lane = block.count; lane < kLanes; ++lane) {
      CHECK(area_of(block, lane).norm() + moment_of(block, lane).norm() == 0);
      CHECK(block.cell[0][lane] == block.cell[0][0]);
    }
}

TEST_CASE("face neighbours stay close in the order of the cells") {
  const Mesh mesh = read_mesh(make_mesh("cube", {{"n", 10}}), 1, PETSC_COMM_SELF);
  double distance = 0, n = 0;
  for_each_face(mesh, [&](const FaceBlock& block, int lane, bool boundary) {
    if (boundary) return;
    distance += std::abs(block.cell[0][lane] - block.cell[1][lane]);
    n += 1;
  });
  CHECK(distance / n < 0.1 * mesh.n_cells);
}
