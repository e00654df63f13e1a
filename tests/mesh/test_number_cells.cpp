#include <algorithm>
#include <catch2/catch.hpp>
#include <utility>

#include "mesh/number_cells.h"
#include "mesh_fixture.h"

using namespace windhover;
using namespace windhover::mesh;

namespace {

/// Owned cells of a mesh on one rank, in their order; slides(patch): whether it is a sliding interface.
template <class Slides>
std::vector<Index> order(const FileMesh& whole, const MeshPart& part, Slides slides) {
  std::vector<bool> sliding;
  for (const PatchName& patch : whole.patches) sliding.push_back(slides(patch));
  const Numbering numbering = number_cells(part, sliding, PETSC_COMM_SELF);
  return {numbering.cell.begin(), numbering.cell.begin() + part.n_owned};
}

/// By how many faces each cell is away from those at an interface.
template <class Slides>
std::vector<int> levels(const FileMesh& whole, const MeshPart& part, Slides slides) {
  constexpr int kFar = 1 << 30;
  std::vector<int> level(part.n_owned, kFar);
  for (Index c = 0; c < part.n_owned; ++c)
    for (const FileSide& side : part.cells[c].sides)
      if (side.patch >= 0 && slides(whole.patches[side.patch])) level[c] = 0;
  for (bool changed = true; std::exchange(changed, false);)
    for (Index c = 0; c < part.n_owned; ++c)
      for (const FileSide& side : part.cells[c].sides)
        if (side.neighbour >= 0 && level[side.neighbour] < kFar && level[side.neighbour] + 1 < level[c]) {
          level[c] = level[side.neighbour] + 1;
          changed = true;
        }
  return level;
}

}  // namespace

TEST_CASE("cells are ordered by zone, in a zone from its sliding interface on") {
  const FileMesh whole = read_gmsh(make_mesh("two_zones", {{"gap", 1}}), 1);
  const MeshPart part = distribute(whole, {}, PETSC_COMM_SELF);
  REQUIRE(whole.zones.size() == 2);
  const auto slides = [](const PatchName& patch) { return patch.zone == 1; };
  const std::vector<int> level = levels(whole, part, slides);
  const auto plain = order(whole, part, [](const PatchName&) { return false; });
  const auto cells = order(whole, part, slides);
  for (const auto& list : {plain, cells}) {
    REQUIRE(std::is_permutation(list.begin(), list.end(), plain.begin()));
    CHECK(std::is_sorted(list.begin(), list.end(), [&](Index a, Index b) { return part.cells[a].zone < part.cells[b].zone; }));
  }
  const auto second = [&](const std::vector<Index>& list) {
    return std::find_if(list.begin(), list.end(), [&](Index c) { return part.cells[c].zone == 1; });
  };
  const auto nearer = [&](Index a, Index b) { return level[a] < level[b]; };
  CHECK(std::is_sorted(second(cells), cells.end(), nearer));
  CHECK(level[*second(cells)] == 0);
  CHECK_FALSE(std::is_sorted(second(plain), plain.end(), nearer));
  CHECK(std::equal(cells.begin(), second(cells), plain.begin()));  // a zone without one: reverse Cuthill-McKee
}
