// Sliding interfaces that cannot be: errors with the place.
#include <catch2/catch.hpp>

#include "base/errors.h"
#include "sliding_fixture.h"

using namespace windhover;
using namespace windhover::mesh;
using Catch::Matchers::Contains;

namespace {

std::string error_of(Mesh& mesh, const SlidingSurface& surface, const std::string& inner = "rotor",
                     const std::string& outer = "ball", double scale = 1) {
  try {
    const SlidingPair pair{surface, find_patch(mesh, "slide", inner), find_patch(mesh, "slide", outer)};
    make_sliding_interfaces(mesh, std::span(&pair, 1), scale);
  } catch (const UserError& e) {
    return e.what();
  }
  return "no error";
}

Mesh cylinder_mesh(const std::map<std::string, double>& numbers = {}, double scale = 1) {
  return read_mesh(make_mesh("cylinder_in_ball", numbers), scale, PETSC_COMM_WORLD);
}

}  // namespace

TEST_CASE("descriptions that are no surface") {
  Mesh mesh = cylinder_mesh();
  SlidingSurface surface = rotor_surface();
  surface.radius = 0;
  CHECK_THAT(error_of(mesh, surface), Contains("radius"));
  surface = rotor_surface(Vec3::Zero());
  CHECK_THAT(error_of(mesh, surface), Contains("axis"));
  surface = rotor_surface();
  surface.z1 = surface.z0;
  CHECK_THAT(error_of(mesh, surface), Contains("cylinder ends"));
}

TEST_CASE("nodes off the surface are told with zone, distance and place in the file's units") {
  Mesh mesh = cylinder_mesh({}, 10);
  SlidingSurface surface = rotor_surface();
  for (double* length : {&surface.radius, &surface.z1}) *length *= 10;
  surface.point *= 10;
  CHECK(error_of(mesh, surface, "rotor", "ball", 10) == "no error");
  mesh = cylinder_mesh({}, 10);
  surface.radius = 6.1;
  CHECK_THAT(error_of(mesh, surface, "rotor", "ball", 10), Contains("surface 'slide' of zone 'rotor'") &&
                                                               Contains("not on the cylinder of radius 0.61") &&
                                                               Contains("the worst is 0.01 off at ("));
}

TEST_CASE("one zone too large or too short") {
  Mesh large = cylinder_mesh({{"dr", 0.01}});
  CHECK_THAT(error_of(large, rotor_surface()), Contains("zone 'rotor'") && Contains("the worst is 0.01 off"));
  Mesh shorter = cylinder_mesh({{"gap", 0.1}});
  CHECK_THAT(error_of(shorter, rotor_surface()), Contains("zone 'rotor'") && Contains("the worst is 0.1 off"));
}

TEST_CASE("a face is missing") {
  Mesh mesh = cylinder_mesh();
  Patch& patch = mesh.patches[find_patch(mesh, "slide", "ball")];
  if (!patch.blocks.empty()) --patch.blocks.back().count;
  CHECK_THAT(error_of(mesh, rotor_surface()), Contains("zone 'ball'") && Contains("gap") && Contains("at ("));
}

TEST_CASE("inside and outside exchanged") {
  Mesh mesh = cylinder_mesh();
  CHECK_THAT(error_of(mesh, rotor_surface(), "ball", "rotor"), Contains("zone 'ball'") && Contains("inside out"));
}

/// Moves the node of a zone that is nearest to a place.
void move_node(Mesh& mesh, const std::string& zone, const Vec3& from, const Vec3& to) {
  Index nearest = -1;
  for (Index c = 0; c < mesh.n_cells; ++c)
    for (Index k = mesh.cell_point_start[c]; k < mesh.cell_point_start[c + 1]; ++k) {
      const Index p = mesh.cell_point[k];
      if (mesh.zones[mesh.cell_zone[c]].name != zone) continue;
      if (nearest < 0 || (mesh.point[p] - from).norm() < (mesh.point[nearest] - from).norm()) nearest = p;
    }
  if (nearest >= 0 && (mesh.point[nearest] - from).norm() < 0.4) mesh.point[nearest] = to;
}

TEST_CASE("a zone that reaches through its surface, and one that reaches into another's") {
  const RevolutionSurface surface(rotor_surface());
  Mesh mesh = cylinder_mesh();
  move_node(mesh, "rotor", surface.to_parent({0, 0, 0.25}), surface.to_parent({0, 0, 0.7}));
  CHECK_THAT(error_of(mesh, rotor_surface()), Contains("interface of zone 'rotor'") &&
                                                  Contains("a blade or cell of zone 'rotor' reaches 0.2 through it, at ("));
  mesh = cylinder_mesh();
  move_node(mesh, "ball", surface.to_parent({1.2, 0, 0.25}), surface.to_parent({0.5, 0, 0.25}));
  CHECK_THAT(error_of(mesh, rotor_surface()), Contains("interface of zone 'rotor'") &&
                                                  Contains("overlap: zone 'ball' reaches 0.1 into it, at ("));
}

TEST_CASE("a face across the rim") {
  Mesh mesh = cylinder_mesh();
  const RevolutionSurface surface(rotor_surface());
  for (Vec3& r : mesh.point) {  // the wall's nodes at mid height go to the upper disc
    const Vec3 x = surface.to_local(r);
    if (surface.place(x).distance > 1e-6 || surface.place(x).parts != bit(Part::wall) || x.z() < 0.35) continue;
    r = surface.to_parent({0.9 * x.x(), 0.9 * x.y(), 0.5});
  }
  CHECK_THAT(error_of(mesh, rotor_surface()), Contains("crosses the cylinder's rim"));
}

TEST_CASE("a mesh too coarse for its curved edges") {
  Mesh mesh = cylinder_mesh({{"h_in", 0.4}, {"h_out", 0.6}, {"h_far", 0.6}});
  CHECK_THAT(error_of(mesh, rotor_surface()), Contains("too coarse") && Contains("zone 'ball'") && Contains("at ("));
}
