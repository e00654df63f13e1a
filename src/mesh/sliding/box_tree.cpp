#include "mesh/sliding/box_tree.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace windhover::mesh {
namespace {

Box box_around(std::span<const Box> boxes, std::span<const int> numbers) {
  Box box;
  for (const int i : numbers) box.extend(boxes[i]);
  return box;
}

/// At the median along the coordinate in which the boxes extend farthest.
std::array<std::span<int>, 2> halve(std::span<const Box> boxes, std::span<int> numbers) {
  Eigen::Index axis = 0;
  box_around(boxes, numbers).sizes().maxCoeff(&axis);
  const size_t half = numbers.size() / 2;
  std::nth_element(numbers.begin(), numbers.begin() + half, numbers.end(),
                   [&](int a, int b) { return boxes[a].center()[axis] < boxes[b].center()[axis]; });
  return {numbers.first(half), numbers.subspan(half)};
}

}  // namespace

BoxTree::BoxTree(std::span<const Box> boxes) {
  std::vector<int> numbers(boxes.size());
  std::iota(numbers.begin(), numbers.end(), 0);
  build(boxes, numbers);
}

int BoxTree::build(std::span<const Box> boxes, std::span<int> numbers) {
  constexpr double kNowhere = std::numeric_limits<double>::infinity();
  std::vector<std::span<int>> parts{numbers};
  while (2 * parts.size() <= kChildren) {
    std::vector<std::span<int>> halves;
    for (const auto& part : parts)
      for (const auto& half : halve(boxes, part))
        if (!half.empty()) halves.push_back(half);
    if (halves.size() == parts.size()) break;
    parts = std::move(halves);
  }
  const int node = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  for (size_t k = 0; k < kChildren; ++k) {
    const bool none = k >= parts.size() || parts[k].empty();
    const Box box = none ? Box(Eigen::Vector3d::Constant(kNowhere), Eigen::Vector3d::Constant(-kNowhere))
                         : box_around(boxes, parts[k]);
    const int child = none ? 0 : parts[k].size() == 1 ? parts[k].front() : ~build(boxes, parts[k]);
    for (int d = 0; d < 3; ++d) {
      nodes_[node].low[d][k] = box.min()[d];
      nodes_[node].high[d][k] = box.max()[d];
    }
    nodes_[node].child[k] = child;
  }
  return node;
}

void BoxTree::find(const Box& box, std::vector<int>& found) const {
  found.clear();
  int waiting[16 * kChildren], n = 0;  // the tree's depth times what is left of each node, at most
  waiting[n++] = 0;
  while (n > 0) {
    const Node& node = nodes_[waiting[--n]];
    const auto meet_along = [&](int d) { return (node.low[d] <= box.max()[d]) & (node.high[d] >= box.min()[d]); };
    const auto meets = meet_along(0) & meet_along(1) & meet_along(2);
    for (int k = 0; k < kChildren; ++k) {
      if (!meets[k]) continue;
      const int child = node.child[k];
      if (child < 0)
        waiting[n++] = ~child;
      else
        found.push_back(child);
    }
  }
  std::sort(found.begin(), found.end());
}

}  // namespace windhover::mesh
