// Sizes along a line: small at its ends, growing inwards.
#pragma once
#include <vector>

namespace windhover::geometry {

struct Grading {
  double length = 1, first = 1, last = 1, largest = 1, growth = 0.3;

  /// The wanted size at a distance from the beginning.
  double size(double s) const;

  /// Fractions of the length from 0 to 1, spaced by the sizes divided by `refine`.
  std::vector<double> fractions(double refine) const;
};

}  // namespace windhover::geometry
