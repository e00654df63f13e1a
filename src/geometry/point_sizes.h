// Sizes given at points, and how they spread.
#pragma once
#include <algorithm>
#include <limits>
#include <vector>

#include "geometry/rotor_options.h"

namespace windhover::geometry {

/// The wanted size at each of many points grows with the distance from it, once that exceeds the size itself.
class PointSizes {
 public:
  PointSizes() = default;
  /// points, sizes: of the same length; growth < 1
  PointSizes(const std::vector<Vec3>& points, const std::vector<double>& sizes, double growth);

  /// The smallest of what all points want here; infinity without points.
  double operator()(const Vec3& point) const;

 private:
  struct Point {
    Vec3 place;
    double size;
  };
  /// Points [begin, end), divided among the node after this one and the node `second`; a leaf when that is 0.
  struct Node {
    int begin, end, second = 0;
    Vec3 low, high;
    double smallest;
  };
  void divide(int begin, int end);
  double grown(double size, double distance) const { return size + growth_ * std::max(0.0, distance - size); }
  void search(int node, const Vec3& point, double& best) const;

  std::vector<Point> points_;
  std::vector<Node> nodes_;  ///< a k-d tree, each node before its parts
  double growth_ = 0;
};

}  // namespace windhover::geometry
