// One implicit stage by dual time (Jameson 1991): explicit steps in a pseudo-time in which F goes to zero.
#pragma once
#include "fluid/stage_solver.h"

namespace windhover::fluid {

struct DualTimeOptions {
  double tolerance = 1e-3;  ///< as Newton's
  int max_iterations = 1000;
  double cfl = 4;  ///< of the pseudo-steps, by the acoustic spectral radius
};

/// dq/dτ = −F(q)/V by rational Runge–Kutta (Wambecq 1978) with a pseudo-step for each cell,
///   1/Δτ = mass + rate Λ/(CFL V),   Λ = ½ Σ_faces (|u·n − v_g·n| + c) |A|, at the first guess.
/// An iteration is one pseudo-step: two residuals and two reductions.
class DualTime : public StageSolver {
 public:
  DualTime(EulerOperator& euler, const DualTimeOptions& options);

  /// Never less than solved, whatever max_newton says: a few pseudo-steps change little.
  StageReport solve(const StageEquation& equation, Vec q, const StageScale& scale, int max_newton,
                    int min_iterations) override;
  Vec left() const override { return first_; }

 private:
  void set_pseudo_steps(const StageEquation& equation, Vec q);
  double residual_norm(const StageEquation& equation, Vec q);
  void pseudo_step(const StageEquation& equation, Vec q);

  EulerOperator& euler_;
  DualTimeOptions options_;
  RoundOff round_off_;
  VecHandle first_, second_, middle_;
  std::vector<double> step_per_volume_;  ///< Δτ/V of each owned cell
};

}  // namespace windhover::fluid
