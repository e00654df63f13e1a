#include "geometry/point_sizes.h"

#include <algorithm>

namespace windhover::geometry {

PointSizes::PointSizes(const std::vector<Vec3>& points, const std::vector<double>& sizes, double growth)
    : growth_(growth) {
  for (size_t i = 0; i < points.size(); ++i) points_.push_back({points[i], sizes[i]});
  if (!points_.empty()) divide(0, static_cast<int>(points_.size()));
}

void PointSizes::divide(int begin, int end) {
  constexpr int leaf = 8;
  Node node{begin, end, 0, points_[begin].place, points_[begin].place, points_[begin].size};
  for (int i = begin; i < end; ++i) {
    node.low = node.low.cwiseMin(points_[i].place);
    node.high = node.high.cwiseMax(points_[i].place);
    node.smallest = std::min(node.smallest, points_[i].size);
  }
  const size_t self = nodes_.size();
  nodes_.push_back(node);
  if (end - begin <= leaf) return;
  int axis;
  (node.high - node.low).maxCoeff(&axis);
  const int middle = (begin + end) / 2;
  std::nth_element(points_.begin() + begin, points_.begin() + middle, points_.begin() + end,
                   [axis](const Point& a, const Point& b) { return a.place[axis] < b.place[axis]; });
  divide(begin, middle);
  nodes_[self].second = static_cast<int>(nodes_.size());
  divide(middle, end);
}

double PointSizes::operator()(const Vec3& point) const {
  double best = std::numeric_limits<double>::infinity();
  if (!nodes_.empty()) search(0, point, best);
  return best;
}

void PointSizes::search(int index, const Vec3& point, double& best) const {
  const Node& node = nodes_[index];
  const double away = (point - point.cwiseMax(node.low).cwiseMin(node.high)).norm();
  if (grown(node.smallest, away) >= best) return;
  if (node.second == 0) {
    for (int i = node.begin; i < node.end; ++i)
      best = std::min(best, grown(points_[i].size, (point - points_[i].place).norm()));
    return;
  }
  const Node& first = nodes_[index + 1];
  const bool first_is_near = (point - (first.low + first.high) / 2).squaredNorm() <
                             (point - (nodes_[node.second].low + nodes_[node.second].high) / 2).squaredNorm();
  search(first_is_near ? index + 1 : node.second, point, best);
  search(first_is_near ? node.second : index + 1, point, best);
}

}  // namespace windhover::geometry
