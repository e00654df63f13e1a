// The equation of one implicit stage, and what solves it.
#pragma once
#include <algorithm>
#include <cmath>
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

/// What the residual of a stage is held against.
struct StageScale {
  double rate = 0;         ///< how fast the flow changes, |V dq/dt|
  double good_enough = 0;  ///< a residual that need not be less
  double before = -1;      ///< residual of the same q under the frames it was last solved with; below 0: there are none

  /// What the residual must fall to.
  double target(double tolerance, double floor) const {
    return std::max({tolerance, good_enough, floor});
  }
  /// The flow's answer to the frames' move since then is less than the error that Newton may leave.
  bool unmoved(double residual, double target) const {
    return before >= 0 && std::abs(residual - before) <= 0.01 * target;
  }
};

class StageSolver {
 public:
  virtual ~StageSolver() = default;

  /// q: first guess in, solution out. Converged: |F| <= tolerance * max(|F(guess)|, scale.rate), or good enough, or at
  /// round-off. With min_iterations > 0 only round-off will do before them, unless the frames' move is not felt
  /// (StageScale::unmoved). max_newton, 0: what the options say, is obeyed where few iterations bring q closer.
  virtual StageReport solve(const StageEquation& equation, Vec q, const StageScale& scale, int max_newton = 0,
                            int min_iterations = 0) = 0;
  /// F(q) of the last solution.
  virtual Vec left() const = 0;
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
