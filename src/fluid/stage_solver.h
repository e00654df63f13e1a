// The equation of one implicit stage, and what solves it.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "fluid/euler.h"

namespace windhover::fluid {

/// F(q) = mass V q + rate R(q, frames) + known = 0.
struct StageEquation {
  Combination combination;
  Frames frames;
};

struct StageIteration {
  double residual = 0;  ///< 2-norm of F after the iteration
  int krylov = 0;
  double seconds = 0;
};

struct StageReport {
  bool converged = false;
  bool failed = false;  ///< not converged, and not for want of iterations
  std::string reason;
  int krylov = 0;                          ///< sum
  std::vector<StageIteration> iterations;  ///< entry 0: the starting residual
};

class StageSolver {
 public:
  virtual ~StageSolver() = default;

  /// q: first guess in, solution out. Converged: |F| <= tolerance * max(|F(guess)|, reference), or at round-off.
  /// With min_iterations > 0 only round-off is good enough before them. max_newton, 0: what the options say, is obeyed
  /// where few iterations bring q closer.
  virtual StageReport solve(const StageEquation& equation, Vec q, double reference, int max_newton = 0,
                            int min_iterations = 0) = 0;
  /// What is kept from one solve to the next is made anew.
  virtual void renew() {}
};

/// The residual that the round-off of its terms leaves.
class RoundOff {
 public:
  explicit RoundOff(const EulerOperator& euler);
  double operator()(const Combination& c) const;

 private:
  double volume_norm_ = 0, surface_norm_ = 0;  ///< sizes of the terms
};

/// A residual that has grown by so much does not come back.
inline constexpr double kDivergence = 1e4;

}  // namespace windhover::fluid
