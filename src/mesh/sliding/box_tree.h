// Which of many boxes meet a given one, in a time that grows with their logarithm.
#pragma once
#include <Eigen/Geometry>
#include <vector>

namespace windhover::mesh {

using Box = Eigen::AlignedBox3d;

/// A binary tree over boxes, each half of the boxes below one child.
class BoxTree {
 public:
  explicit BoxTree(std::vector<Box> boxes);

  /// Replaces `found` by the numbers of all boxes that meet the given one, ascending.
  void find(const Box& box, std::vector<int>& found) const;

 private:
  struct Node {
    Box box;
    int begin = 0, end = 0;  ///< into order_
    int right = 0;           ///< 0: a leaf; the left child follows its parent
  };
  void build(int begin, int end);

  std::vector<Box> boxes_;  ///< once built: by order_
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

}  // namespace windhover::mesh
