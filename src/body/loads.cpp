#include "body/loads.h"

#include <cassert>

namespace windhover::body {

LoadPolynomial::LoadPolynomial(std::vector<Point> points) {
  assert(!points.empty() && points.size() <= 3);
  for (Point& point : points) {
    times_.push_back(point.t);
    coefficients_.push_back(std::move(point.loads));
  }
  const std::size_t n = times_.size();
  for (std::size_t order = 1; order < n; ++order)
    for (std::size_t i = n - 1; i >= order; --i)
      coefficients_[i] = (coefficients_[i] - coefficients_[i - 1]) / (times_[i] - times_[i - order]);
}

void LoadPolynomial::evaluate(double t, std::span<double> loads) const {
  Eigen::Map<Eigen::VectorXd> value(loads.data(), static_cast<Eigen::Index>(loads.size()));
  value = coefficients_.back();
  for (std::size_t i = coefficients_.size() - 1; i-- > 0;) value = coefficients_[i] + (t - times_[i]) * value;
}

Eigen::VectorXd LoadPolynomial::at(double t) const {
  Eigen::VectorXd loads(size());
  evaluate(t, {loads.data(), static_cast<std::size_t>(loads.size())});
  return loads;
}

}  // namespace windhover::body
