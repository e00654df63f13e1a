// Cells and faces at a sliding interface after their edges are curved.
#include <catch2/catch.hpp>
#include <numbers>

#include "sliding_fixture.h"

using namespace windhover;
using namespace windhover::mesh;
using std::numbers::pi;

namespace {

double zone_volume(const Mesh& mesh, int zone) {
  double volume = 0;
  for (Index i = 0; i < mesh.n_owned; ++i)
    if (mesh.cell_zone[i] == zone) volume += mesh.volume[i];
  return total(volume, mesh.comm);
}

Vec3 zone_centroid(const Mesh& mesh, int zone) {
  Vec3 first = Vec3::Zero();
  for (Index i = 0; i < mesh.n_owned; ++i)
    if (mesh.cell_zone[i] == zone) first += mesh.volume[i] * mesh.centroid[i];
  MPI_Allreduce(MPI_IN_PLACE, first.data(), 3, MPI_DOUBLE, MPI_SUM, mesh.comm);
  return first / zone_volume(mesh, zone);
}

std::map<PetscInt, Index> by_file_number(const Mesh& mesh) {
  std::map<PetscInt, Index> local;
  for (Index i = 0; i < mesh.n_owned; ++i) local[mesh.file_cell[i]] = i;
  return local;
}

double side_area(const SlidingInterface& interface, int side) {
  double area = 0;
  for (const InterfaceFace& face : interface.faces(side)) area += face.size;
  return area;
}

void check_closed(const SlidingCase& c, double area, double volume, const Vec3& centroid, double tolerance = 1e-13) {
  const Opening open = opening(c.mesh);
  UNSCOPED_INFO("open in area " << open.area << ", in moment " << open.moment);
  CHECK(open.area < 1e-13);
  CHECK(open.moment < 1e-13);
  for (int side = 0; side < 2; ++side) CHECK(std::abs(side_area(c.interface(), side) / area - 1) < 1e-13);
  CHECK(std::abs(zone_volume(c.mesh, c.interface().zone(0)) / volume - 1) < 1e-13);
  CHECK((zone_centroid(c.mesh, c.interface().zone(0)) - centroid).norm() < tolerance);
}

void check_cylinder(const SlidingCase& c, const Vec3& axis) {
  check_closed(c, 2 * pi * 0.6 * (0.5 + 0.6), pi * 0.36 * 0.5, rotor_surface().point + 0.25 * axis);
}

}  // namespace

TEST_CASE("cells at a cylinder close to round-off and fill it exactly") {
  check_cylinder(cylinder_case(), tilted_axis);
  check_cylinder(cylinder_case({{"h_in", 0.4}, {"h_out", 0.3}}), tilted_axis);
  check_cylinder(cylinder_case({{"layers", 4}, {"h_in", 0.2}}), Vec3::UnitZ());
  check_cylinder(cylinder_case({{"layers", 3}, {"quads", 1}}), Vec3::UnitZ());
}

TEST_CASE("cells at a sphere close to round-off and fill it exactly") {
  check_closed(sphere_case(), pi, pi / 6, ball_surface().point);
  // on a sphere the cells' centroids are integrated numerically
  check_closed(sphere_case({{"h_in", 0.4}}), pi, pi / 6, ball_surface().point, 1e-9);
}

TEST_CASE("a zone between two interfaces: a child of a child") {
  Mesh mesh = read_mesh(make_mesh("sphere_in_box", {{"child", 1}}), 1, PETSC_COMM_WORLD);
  const SlidingSurface rotor{.point = ball_surface().point, .axis = Vec3::UnitY(), .radius = 0.2, .z1 = 0.1};
  const std::vector<SlidingPair> pairs{
      {ball_surface(), find_patch(mesh, "slide", "ball"), find_patch(mesh, "slide", "box")},
      {rotor, find_patch(mesh, "rotor_slide", "rotor"), find_patch(mesh, "rotor_slide", "ball")}};
  const std::vector<SlidingInterface> interfaces = make_sliding_interfaces(mesh, pairs, 1);
  CHECK(opening(mesh).area < 1e-13);
  CHECK(opening(mesh).moment < 1e-13);
  const double rotor_volume = pi * 0.04 * 0.1;
  CHECK(std::abs(zone_volume(mesh, interfaces[0].zone(0)) + rotor_volume - pi / 6) < 1e-13);
  CHECK(std::abs(zone_volume(mesh, interfaces[1].zone(0)) - rotor_volume) < 1e-13);
  for (const SlidingInterface& interface : interfaces) CHECK(interface.audit(0.8, interface.pieces(0.8)) < 1e-12);
}

TEST_CASE("curved edges change nothing away from the surface") {
  const SlidingCase c = cylinder_case();
  const Mesh straight = read_mesh(make_mesh("cylinder_in_ball"), 1, PETSC_COMM_SELF);
  const RevolutionSurface surface(rotor_surface());
  int changed = 0;
  const std::map<PetscInt, Index> local = by_file_number(c.mesh);
  for (Index i = 0; i < straight.n_owned; ++i) {
    const auto found = local.find(straight.file_cell[i]);
    if (found == local.end()) continue;
    double distance = 1;
    for (Index k = straight.cell_point_start[i]; k < straight.cell_point_start[i + 1]; ++k)
      distance = std::min(distance, surface.place(surface.to_local(straight.point[straight.cell_point[k]])).distance);
    const Index j = found->second;
    const bool same = straight.volume[i] == c.mesh.volume[j] && straight.centroid[i] == c.mesh.centroid[j];
    CHECK((same || distance < 1e-6));
    changed += same ? 0 : 1;
  }
  CHECK(total(changed, c.mesh.comm) > 1000);
}

TEST_CASE("arms still point from the cells' centroids to one place") {
  const SlidingCase c = cylinder_case({{"layers", 4}, {"h_in", 0.2}});
  double worst = 0;
  for (const FaceBlock& b : c.mesh.faces)
    for (int lane = 0; lane < b.count; ++lane)
      worst = std::max(worst, (c.mesh.centroid[b.cell[0][lane]] + arm_of(b, lane, 0) -
                               c.mesh.centroid[b.cell[1][lane]] - arm_of(b, lane, 1))
                                  .norm());
  CHECK(worst < 1e-15);
}

TEST_CASE("two ranks see the same bits of a curved cell as one") {
  const SlidingCase all = cylinder_case(), alone = cylinder_case({}, PETSC_COMM_SELF);
  const std::map<PetscInt, Index> local = by_file_number(alone.mesh);
  for (Index i = 0; i < all.mesh.n_owned; ++i) {
    const Index j = local.at(all.mesh.file_cell[i]);
    CHECK(all.mesh.volume[i] == alone.mesh.volume[j]);
    CHECK(all.mesh.centroid[i] == alone.mesh.centroid[j]);
  }
}
