// Advances the flow by one time step of any scheme.
#pragma once
#include <functional>

#include "fluid/flow_state.h"
#include "fluid/stage_methods.h"
#include "fluid/time_scheme.h"

namespace windhover::fluid {

struct FlowOptions {
  const TimeScheme* scheme = &kTimeSchemes[0];
  int start_steps = 0;      ///< backward-Euler steps first: Crank–Nicolson does not damp an impulsive start
  double damping = 0;       ///< w of (1 − w) Crank–Nicolson + w BDF2, see bdf2_coefficients
  double truncation_fraction = 0;  ///< of a step's truncation error, where it is known, that its residual may have
  bool extrapolate = true;  ///< first guess by extrapolation in time (prediction.h)
  int jacobian_lag = 1;     ///< steps that a preconditioner serves at most
  const StageMethod* method = &kStageMethods[0];
  NewtonOptions newton;
  DualTimeOptions dual_time;
};

struct StepReport {
  bool accepted = false;  ///< every stage is converged
  bool failed = false;    ///< more iterations would not help
  std::string reason;
  std::vector<StageReport> stages;  ///< implicit stages in order, those of every iterate() one after the other
  int newton() const;  ///< or pseudo-steps
  int krylov() const;
};

/// Frames of all zones at a time.
using FrameFunction = std::function<Frames(double)>;

class FlowSolver {
 public:
  FlowSolver(EulerOperator& euler, const FlowOptions& options);

  FlowState& state() { return state_; }
  const FlowState& state() const { return state_; }
  EulerOperator& euler() { return euler_; }
  const EulerOperator& euler() const { return euler_; }

  /// One step of size dt. Accepted: state() is the new one. Otherwise state() is unchanged and the reason is told.
  StepReport advance(const FrameFunction& frames, double dt);

  /// The same in parts, for frames that depend on the flow: what is known at the start (the rate R(q_n), first guesses)
  /// is computed once, then the step is solved again and again, each time from the last iterate on.
  void begin(const FrameFunction& frames, double dt);
  /// StageSolver::solve for each stage; frames must not change at the start of the step.
  const StepReport& iterate(const FrameFunction& frames, int max_newton = 0, int min_iterations = 0);
  /// The latest iterate: what the state becomes if it is accepted.
  Vec iterate() const { return stages_.back(); }
  void accept();
  /// The next step makes its preconditioner anew, as one after a restart does.
  void renew() { jacobian_ = {}; }
  /// Order in time of the step begun.
  int order() const { return current_scheme().order; }

 private:
  const TimeScheme& current_scheme() const;
  double bdf2_weight() const;
  bool stale(double dt) const;
  void note_krylov();
  bool solve_stage(const TimeScheme& scheme, int i, const FrameFunction& frames, int max_newton, int min_iterations);
  void iterate_explicit(const TimeScheme& scheme, const FrameFunction& frames);
  void explicit_state(const double* coefficients, int stages, double dt, Vec out);
  void predict(double dt, const Frames& now, Vec out) const;
  double rate_norm() const;
  double third_derivative() const;
  double good_enough(double rate) const;

  EulerOperator& euler_;
  FlowOptions options_;
  std::unique_ptr<StageSolver> stage_solver_;  ///< implicit schemes only
  FlowState state_;
  VecHandle known_;
  std::vector<VecHandle> stages_;  ///< iterates
  std::vector<VecHandle> rates_;   ///< R_j of the stages that later ones need
  std::vector<StageScale> scales_;  ///< of each stage
  double dt_ = 0;                  ///< of the step begun
  double rate_factor_ = 1;         ///< of R in the stage last solved
  struct {
    double dt = 0;   ///< of the step for which it was made; 0: there is none
    long step = 0;
    int fresh = -1;  ///< Krylov iterations of its first linear solve; below 0: not known yet
    int excess = 0;  ///< of those of later steps over that, summed
  } jacobian_;       ///< of the preconditioner
  StepReport report_;
};

}  // namespace windhover::fluid
