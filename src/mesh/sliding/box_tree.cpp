#include "mesh/sliding/box_tree.h"

#include <algorithm>
#include <numeric>

namespace windhover::mesh {

BoxTree::BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  if (!boxes_.empty()) build(0, static_cast<int>(boxes_.size()));
  std::vector<Box> in_order;
  for (const int i : order_) in_order.push_back(boxes_[i]);
  boxes_ = std::move(in_order);
}

void BoxTree::build(int begin, int end) {
  constexpr int leaf_size = 4;
  const std::size_t node = nodes_.size();
  nodes_.push_back({.box = {}, .begin = begin, .end = end, .right = 0});
  for (int k = begin; k < end; ++k) nodes_[node].box.extend(boxes_[order_[k]]);
  if (end - begin <= leaf_size) return;
  Eigen::Index axis = 0;
  nodes_[node].box.sizes().maxCoeff(&axis);
  const int middle = (begin + end) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](int a, int b) { return boxes_[a].center()[axis] < boxes_[b].center()[axis]; });
  build(begin, middle);
  nodes_[node].right = static_cast<int>(nodes_.size());
  build(middle, end);
}

void BoxTree::find(const Box& box, std::vector<int>& found) const {
  found.clear();
  int waiting[64], n = 0;  // the tree's depth at most
  if (!nodes_.empty()) waiting[n++] = 0;
  while (n > 0) {
    const int i = waiting[--n];
    const Node& node = nodes_[i];
    if (!node.box.intersects(box)) continue;
    if (node.right > 0) {
      waiting[n++] = node.right;
      waiting[n++] = i + 1;
      continue;
    }
    for (int k = node.begin; k < node.end; ++k)
      if (boxes_[k].intersects(box)) found.push_back(order_[k]);
  }
  std::sort(found.begin(), found.end());
}

}  // namespace windhover::mesh
