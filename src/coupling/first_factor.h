// The first relaxation factor of a step: what the step before found best, as Küttler & Wall start Aitken's relaxation
// (Comput. Mech. 43, 2008, section 5).
#pragma once
#include <algorithm>
#include <span>
#include <vector>

#include "coupling/scheme.h"

namespace windhover::coupling {

/// The factor that would have brought two scaled residuals, the second after a step with `factor`, to zero on the line
/// between them; `factor` itself where they tell nothing.
inline double aitken_factor(const VectorXd& before, const VectorXd& after, double factor) {
  const VectorXd change = after - before;
  return change.squaredNorm() > 0 ? factor * -before.dot(change) / change.squaredNorm() : factor;
}

class FirstFactor {
 public:
  /// `largest` is used until something is known, and never exceeded.
  explicit FirstFactor(double largest) : largest_(largest), factor_(largest) {}

  /// The factor of the step that begins.
  double begin() {
    residuals_.clear();
    return factor_;
  }
  /// The step's residuals, scaled, in order; the first two count: their difference is the largest, with the least of
  /// Newton's error.
  void observe(const VectorXd& residual) {
    if (residuals_.size() < 2) residuals_.push_back(residual);
  }
  /// The step is accepted.
  void keep() {
    if (residuals_.size() < 2) return;
    factor_ = std::clamp(aitken_factor(residuals_[0], residuals_[1], factor_), kLeastPart * largest_, largest_);
  }

  std::vector<double> state() const { return {factor_}; }
  void restore(std::span<const double> state) { factor_ = state.empty() ? largest_ : state[0]; }

 private:
  static constexpr double kLeastPart = 0.05;
  double largest_, factor_;
  std::vector<VectorXd> residuals_;
};

}  // namespace windhover::coupling
