#include "geometry/grading.h"

#include <algorithm>
#include <cmath>

namespace windhover::geometry {

double Grading::size(double s) const {
  return std::min({largest, first + growth * s, last + growth * (length - s)});
}

std::vector<double> Grading::fractions(double refine) const {
  constexpr int samples = 2000;
  std::vector<double> cells(samples + 1, 0);  // cells from the beginning up to a sample
  const double ds = length / samples;
  for (int i = 0; i < samples; ++i) cells[i + 1] = cells[i] + ds / size((i + 0.5) * ds);
  const int n = std::max(2, static_cast<int>(std::lround(refine * cells.back())));
  std::vector<double> fractions{0};
  for (int k = 1; k < n; ++k) {
    const double wanted = cells.back() * k / n;
    const auto above = std::upper_bound(cells.begin(), cells.end(), wanted);
    const double below = *(above - 1);
    fractions.push_back((double(above - cells.begin() - 1) + (wanted - below) / (*above - below)) / samples);
  }
  fractions.push_back(1);
  return fractions;
}

}  // namespace windhover::geometry
