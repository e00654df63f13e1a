#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>

#include "mesh/number_cells.h"
#include "mesh_fixture.h"

using namespace windhover;
using namespace windhover::mesh;

namespace {

MeshPart own_part(const std::string& file) {
  const FileMesh whole = read_gmsh(file, 1);
  return distribute(whole, {}, PETSC_COMM_SELF);
}

Vec3 centre(const FileCell& cell) {
  Vec3 sum = Vec3::Zero();
  const int n = static_cast<int>(cell.type);
  for (int k = 0; k < n; ++k) sum += cell.corners[k].position;
  return sum / n;
}

/// The owned cells of each zone in their order, and that zones follow each other and no cell is left out.
std::vector<std::vector<Vec3>> centres_by_zone(const MeshPart& part, const Numbering& numbering) {
  std::vector<Index> sorted(numbering.cell.begin(), numbering.cell.begin() + part.n_owned), all(part.n_owned);
  std::sort(sorted.begin(), sorted.end());
  std::iota(all.begin(), all.end(), 0);
  REQUIRE(sorted == all);
  std::vector<std::vector<Vec3>> zones;
  for (Index i = 0; i < part.n_owned; ++i) {
    const FileCell& cell = part.cells[numbering.cell[i]];
    REQUIRE(cell.zone + 1 >= static_cast<int>(zones.size()));
    zones.resize(cell.zone + 1);
    zones.back().push_back(centre(cell));
  }
  return zones;
}

}  // namespace

TEST_CASE("large zones are ordered in pieces that a plane separates") {
  const MeshPart part = own_part(make_mesh("two_zones", {{"gap", 1}}));
  const auto whole = centres_by_zone(part, number_cells(part, PETSC_COMM_SELF));
  REQUIRE(whole.size() == 2);
  const auto largest = static_cast<Index>(std::min(whole[0].size(), whole[1].size()) - 1);
  const auto pieces = centres_by_zone(part, number_cells(part, PETSC_COMM_SELF, largest));
  for (size_t zone = 0; zone < 2; ++zone) {
    const auto separated = [](const std::vector<Vec3>& cells) {
      const auto half = cells.begin() + static_cast<std::ptrdiff_t>(cells.size() / 2);
      for (int d = 0; d < 3; ++d) {
        const auto less = [d](const Vec3& a, const Vec3& b) { return a[d] < b[d]; };
        if ((*std::max_element(cells.begin(), half, less))[d] <= (*std::min_element(half, cells.end(), less))[d])
          return true;
      }
      return false;
    };
    CHECK(separated(pieces[zone]));
    CHECK_FALSE(separated(whole[zone]));
  }
}
