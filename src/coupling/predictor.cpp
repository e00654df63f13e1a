#include "coupling/predictor.h"

#include <cmath>

namespace windhover::coupling {
namespace {

using Point = body::LoadPolynomial::Point;

/// Weights of the loads one, two and three steps before, in front of the value they predict.
struct Rule {
  double weight[3];
};
constexpr Rule kRules[] = {{2, -1, 0}, {3, -3, 1}, {1, 1, -1}};

VectorXd apply(const Rule& rule, std::span<const Point> known) {
  const size_t n = known.size();
  return rule.weight[0] * known[n - 1].loads + rule.weight[1] * known[n - 2].loads +
         rule.weight[2] * known[n - 3].loads;
}

bool equal_steps(std::span<const Point> known, double end) {
  const double last = end - known.back().t;
  for (size_t i = 1; i < known.size(); ++i)
    if (std::abs(known[i].t - known[i - 1].t - last) > 1e-6 * last) return false;
  return true;
}

}  // namespace

VectorXd predict(Prediction prediction, std::span<const Point> known, double end, const VectorXd& scale) {
  if (prediction == Prediction::hold || known.size() == 1) return known.back().loads;
  if (prediction == Prediction::best && known.size() == kKeptLoads && equal_steps(known, end)) {
    const auto before = known.first(kKeptLoads - 1);
    const Rule* best = nullptr;
    double least = HUGE_VAL;
    for (const Rule& rule : kRules) {
      const double error = (apply(rule, before) - known.back().loads).cwiseQuotient(scale).norm();
      if (error < least) least = error, best = &rule;
    }
    if (best) return apply(*best, known);
  }
  const auto last = known.last(2);
  return body::LoadPolynomial({last.begin(), last.end()}).at(end);
}

}  // namespace windhover::coupling
