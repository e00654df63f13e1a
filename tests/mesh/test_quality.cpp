#include "mesh/quality.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "mesh_fixture.h"

using namespace windhover;
using namespace windhover::mesh;

TEST_CASE("quality of a box of equal hexahedra") {
  const Mesh mesh = read_mesh(make_mesh("box", {{"nx", 8}, {"ny", 5}, {"nz", 4}}), 2, PETSC_COMM_WORLD);
  const Quality quality = measure_quality(mesh);
  CHECK(quality.smallest_edge.value == Approx(2.0 / 8));
  CHECK(quality.smallest_dihedral_deg.value == Approx(90));
  CHECK(quality.largest_volume_ratio.value == Approx(1));
  CHECK(quality.smallest_cell.value == Approx(std::cbrt(2.0 / 8 * 2 / 5 * 2 / 4)));
}

TEST_CASE("quality of tetrahedra is found at the same place on any number of ranks") {
  const std::string file = make_mesh("cube");
  const Quality a = measure_quality(read_mesh(file, 1, PETSC_COMM_WORLD));
  const Quality b = measure_quality(read_mesh(file, 1, PETSC_COMM_SELF));
  CHECK(a.smallest_edge.value == b.smallest_edge.value);
  CHECK(a.smallest_dihedral_deg.value == b.smallest_dihedral_deg.value);
  CHECK(a.largest_volume_ratio.value == b.largest_volume_ratio.value);
  CHECK(a.smallest_cell.value == b.smallest_cell.value);
  CHECK((a.smallest_dihedral_deg.place - b.smallest_dihedral_deg.place).norm() < 1e-14);
  CHECK(a.smallest_dihedral_deg.value > 1);
  CHECK(a.smallest_dihedral_deg.value < 60);
  CHECK(a.largest_volume_ratio.value > 1.5);
}
