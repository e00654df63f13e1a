#include "geometry/spline.h"

#include <algorithm>

namespace windhover::geometry {

Spline::Spline(std::vector<double> x, std::vector<double> y) : x_(std::move(x)), y_(std::move(y)), second_(x_.size(), 0) {
  const size_t n = x_.size();
  std::vector<double> above(n, 0);  // the tridiagonal system's eliminated upper diagonal
  for (size_t i = 1; i + 1 < n; ++i) {
    const double h0 = x_[i] - x_[i - 1], h1 = x_[i + 1] - x_[i];
    const double right = 6 * ((y_[i + 1] - y_[i]) / h1 - (y_[i] - y_[i - 1]) / h0);
    const double pivot = 2 * (h0 + h1) - h0 * above[i - 1];
    above[i] = h1 / pivot;
    second_[i] = (right - h0 * second_[i - 1]) / pivot;
  }
  for (size_t i = n - 1; i-- > 1;) second_[i] -= above[i] * second_[i + 1];
}

double Spline::operator()(double x) const {
  const size_t i = std::clamp<size_t>(std::upper_bound(x_.begin(), x_.end(), x) - x_.begin(), 1, x_.size() - 1) - 1;
  const double h = x_[i + 1] - x_[i], a = (x_[i + 1] - x) / h, b = 1 - a;
  return a * y_[i] + b * y_[i + 1] + h * h / 6 * ((a * a * a - a) * second_[i] + (b * b * b - b) * second_[i + 1]);
}

}  // namespace windhover::geometry
