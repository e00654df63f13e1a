// Natural cubic spline through given points.
#pragma once
#include <vector>

namespace windhover::geometry {

class Spline {
 public:
  /// x increasing, at least two points; through two it is a line.
  Spline(std::vector<double> x, std::vector<double> y);
  double operator()(double x) const;

 private:
  std::vector<double> x_, y_, second_;  ///< second derivatives at the points
};

}  // namespace windhover::geometry
