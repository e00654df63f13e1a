#include <catch2/catch.hpp>

#include "mesh/mesh.h"
#include "mesh_fixture.h"
#include "mesh_sums.h"

using namespace windhover;
using namespace windhover::mesh;

namespace {

double patch_area(const Mesh& mesh, const Patch& patch) {
  double area = 0;
  for (const FaceBlock& block : patch.blocks)
    for (int lane = 0; lane < block.count; ++lane) area += area_of(block, lane).norm();
  return total(area, mesh.comm);
}

void check_two_zones(const Mesh& mesh) {
  REQUIRE(mesh.zones.size() == 2);
  CHECK(mesh.zones[0].name == "left");
  CHECK(mesh.zones[1].name == "right");
  CHECK(std::is_sorted(mesh.cell_zone.begin(), mesh.cell_zone.begin() + mesh.n_owned));
  for (int zone = 0; zone < 2; ++zone)
    for (Index b = mesh.zones[zone].faces.begin; b < mesh.zones[zone].faces.end; ++b)
      for (int lane = 0; lane < kLanes; ++lane)
        for (int side = 0; side < 2; ++side) CHECK(mesh.cell_zone[mesh.faces[b].cell[side][lane]] == zone);
  CHECK(opening(mesh).area < 3e-15);
  CHECK(opening(mesh).moment < 1e-14);
  CHECK(owned_volume(mesh) == Approx(2));
}

}  // namespace

TEST_CASE("zones apart: a patch name of both becomes a patch of each") {
  const Mesh mesh = read_mesh(make_mesh("two_zones", {{"gap", 1}}), 1, PETSC_COMM_WORLD);
  check_two_zones(mesh);
  REQUIRE(mesh.patches.size() == 2);
  for (int zone = 0; zone < 2; ++zone) {
    CHECK(mesh.patches[zone].name == "far");
    CHECK(mesh.patches[zone].zone == zone);
    CHECK(patch_area(mesh, mesh.patches[zone]) == Approx(6));
  }
}

TEST_CASE("zones with common nodes are cut along their named surface") {
  const Mesh mesh = read_mesh(make_mesh("two_zones"), 1, PETSC_COMM_WORLD);
  check_two_zones(mesh);
  REQUIRE(mesh.patches.size() == 4);
  CHECK(mesh.patches[2].name == "between");
  CHECK(mesh.patches[3].name == "between");
  CHECK(patch_area(mesh, mesh.patches[2]) == Approx(1));
  CHECK(patch_area(mesh, mesh.patches[3]) == Approx(1));
  // no node belongs to cells of both
  std::vector<int> zone_of_node(mesh.n_nodes, -1);
  for (Index i = 0; i < mesh.n_cells; ++i)
    for (Index k = mesh.cell_point_start[i]; k < mesh.cell_point_start[i + 1]; ++k) {
      int& zone = zone_of_node[mesh.point_node[mesh.cell_point[k]]];
      REQUIRE((zone < 0 || zone == mesh.cell_zone[i]));
      zone = mesh.cell_zone[i];
    }
}
