#include "mesh/sliding/box_tree.h"

#include <catch2/catch.hpp>
#include <random>

using windhover::mesh::Box;
using windhover::mesh::BoxTree;

TEST_CASE("the tree of boxes finds what a search through all finds") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-1, 1), size(0, 0.2);
  const auto box = [&] {
    const Eigen::Vector3d low(place(random), place(random), place(random));
    return Box(low, low + Eigen::Vector3d(size(random), size(random), size(random)));
  };
  std::vector<Box> boxes(500);
  for (Box& b : boxes) b = box();
  const BoxTree tree(boxes);
  std::vector<int> found;
  for (int trial = 0; trial < 100; ++trial) {
    const Box query = box();
    std::vector<int> expected;
    for (int i = 0; i < 500; ++i)
      if (boxes[i].intersects(query)) expected.push_back(i);
    tree.find(query, found);
    CHECK(found == expected);
  }
  BoxTree(std::span<const Box>()).find(boxes[0], found);
  CHECK(found.empty());
}
