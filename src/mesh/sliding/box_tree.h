// Which of many boxes meet a given one, in a time that grows with their logarithm.
#pragma once
#include <Eigen/Geometry>
#include <span>
#include <vector>

namespace windhover::mesh {

using Box = Eigen::AlignedBox3d;

/// A tree of nodes with four children each, whose boxes are compared at once.
class BoxTree {
 public:
  explicit BoxTree(std::span<const Box> boxes);

  /// Replaces `found` by the numbers of all boxes that meet the given one, ascending.
  void find(const Box& box, std::vector<int>& found) const;

 private:
  static constexpr int kChildren = 4;
  typedef double Four __attribute__((vector_size(kChildren * sizeof(double))));
  struct Node {
    Four low[3], high[3];  ///< of the children's boxes; low above high where there is no child
    int child[kChildren];   ///< number of a box, or ~node
  };
  /// Number of the new node above the boxes with these numbers.
  int build(std::span<const Box> boxes, std::span<int> numbers);

  std::vector<Node> nodes_;
};

}  // namespace windhover::mesh
