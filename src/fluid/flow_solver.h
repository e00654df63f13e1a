// Advances the flow by one time step of any scheme.
#pragma once
#include <functional>

#include "fluid/newton.h"
#include "fluid/time_scheme.h"

namespace windhover::fluid {

/// All that the next step depends on.
struct FlowState {
  VecHandle q;         ///< conserved variables at `time`
  VecHandle previous;  ///< one accepted step earlier
  double time = 0;
  double last_step = 0;  ///< time since `previous`; 0: there is none
  long step = 0;
};

struct FlowOptions {
  const TimeScheme* scheme = &kTimeSchemes[0];
  int start_steps = 0;      ///< backward-Euler steps first: Crank–Nicolson does not damp an impulsive start
  bool extrapolate = true;  ///< first guess by linear extrapolation in time
  int jacobian_lag = 1;     ///< steps between rebuilds of the preconditioner
  NewtonOptions newton;
};

struct StepReport {
  bool accepted = false;
  std::string reason;
  std::vector<NewtonReport> stages;  ///< implicit stages in order
  int newton() const;
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

  /// One step of size dt. Accepted: state() is the new one. Otherwise state() is unchanged and the reason is told.
  StepReport advance(const FrameFunction& frames, double dt);

 private:
  const TimeScheme& current_scheme() const;
  bool solve_stage(const TimeScheme& scheme, int i, const FrameFunction& frames, double dt, StepReport& report);
  void explicit_state(const double* coefficients, int stages, double dt, Vec out);
  void predict(double fraction, double dt, Vec out) const;
  bool is_physical(Vec q) const;
  double rate_norm() const;

  EulerOperator& euler_;
  FlowOptions options_;
  std::optional<NewtonKrylov> newton_;  ///< implicit schemes only
  FlowState state_;
  VecHandle stage_, known_;
  std::vector<VecHandle> rates_;  ///< R_j of the stages that later ones need
};

}  // namespace windhover::fluid
