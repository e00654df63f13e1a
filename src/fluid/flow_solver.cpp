#include "fluid/flow_solver.h"

#include <algorithm>
#include <cmath>

#include "fluid/prediction.h"

namespace windhover::fluid {
namespace {

/// y += alpha V x, per cell.
void add_times_volume(const mesh::Mesh& mesh, double alpha, Vec x, Vec y) {
  const double* from = nullptr;
  double* to = nullptr;
  petsc(VecGetArrayRead(x, &from));
  petsc(VecGetArray(y, &to));
  for (mesh::Index c = 0; c < mesh.n_owned; ++c)
    for (int k = 0; k < kVariables; ++k) to[5 * c + k] += alpha * mesh.volume[c] * from[5 * c + k];
  petsc(VecRestoreArrayRead(x, &from));
  petsc(VecRestoreArray(y, &to));
}

}  // namespace

int StepReport::newton() const {
  int sum = 0;
  for (const auto& s : stages) sum += static_cast<int>(s.iterations.size()) - 1;
  return sum;
}

int StepReport::krylov() const {
  int sum = 0;
  for (const auto& s : stages) sum += s.krylov;
  return sum;
}

FlowSolver::FlowSolver(EulerOperator& euler, const FlowOptions& options)
    : euler_(euler), options_(options) {
  if (options_.scheme->implicit) stage_solver_ = options.method->make(euler, options.newton, options.dual_time);
  state_.q = euler.make_vector();
  state_.previous = euler.make_vector();
  if (options_.scheme->implicit && options_.extrapolate) state_.earlier = euler.make_vector();
  if (options_.scheme->implicit && options_.scheme->a[0][0] == 0) state_.remainder = euler.make_vector();
  known_ = euler.make_vector();
  for (int i = 0; i < options_.scheme->stages; ++i) {
    const bool solved = options_.scheme->implicit ? options_.scheme->a[i][i] != 0 : i + 1 == options_.scheme->stages;
    stages_.push_back(solved ? euler.make_vector() : VecHandle());
  }
  const int kept = options_.scheme->stages - (options_.scheme->implicit ? 1 : 0);
  for (int j = 0; j < kept; ++j) rates_.push_back(euler.make_vector());
}

const TimeScheme& FlowSolver::current_scheme() const {
  static const TimeScheme& backward_euler = time_scheme("backward_euler");
  const bool starting = options_.scheme->implicit && state_.step < options_.start_steps;
  const bool no_history = options_.scheme->bdf2 && state_.last_step == 0;
  return starting || no_history ? backward_euler : *options_.scheme;
}

/// Weight of BDF2 in the step: 1 for BDF2 itself, `damping` in Crank–Nicolson.
double FlowSolver::bdf2_weight() const {
  const TimeScheme& scheme = current_scheme();
  if (scheme.bdf2) return 1;
  return scheme.damped && state_.last_step > 0 ? options_.damping : 0;
}

/// Norm of V (q_n − q_{n−1}) / Δt: how fast the flow changes, what the residual is compared with.
double FlowSolver::rate_norm() const {
  if (state_.last_step == 0) return 0;
  const double *now = nullptr, *before = nullptr;
  petsc(VecGetArrayRead(state_.q, &now));
  petsc(VecGetArrayRead(state_.previous, &before));
  double sum = 0;
  for (mesh::Index c = 0; c < euler_.mesh().n_owned; ++c)
    for (int k = 0; k < kVariables; ++k) {
      const double change = euler_.mesh().volume[c] * (now[5 * c + k] - before[5 * c + k]);
      sum += change * change;
    }
  petsc(VecRestoreArrayRead(state_.q, &now));
  petsc(VecRestoreArrayRead(state_.previous, &before));
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, euler_.mesh().comm);
  return std::sqrt(sum) / state_.last_step;
}

/// |V d³q/dt³| at t_n, for schemes that know R(q_n): dq/dt there from the step done and the one before, and what R says, differ by
/// Δt_n Δt_{n−1}/6 of it.
double FlowSolver::third_derivative() const {
  const TimeScheme& scheme = current_scheme();
  if (options_.truncation_fraction == 0 || !scheme.implicit || scheme.a[0][0] != 0 || state_.last_step == 0) return 0;
  const double r = dt_ / state_.last_step, forward = 1 / (dt_ * (1 + r)), backward = r / (state_.last_step * (1 + r));
  const double *next = nullptr, *now = nullptr, *before = nullptr, *rate = nullptr;
  petsc(VecGetArrayRead(stages_.back(), &next));
  petsc(VecGetArrayRead(state_.q, &now));
  petsc(VecGetArrayRead(state_.previous, &before));
  petsc(VecGetArrayRead(rates_[0], &rate));
  double sum = 0;
  for (mesh::Index c = 0; c < euler_.mesh().n_owned; ++c)
    for (mesh::Index i = kVariables * c; i < kVariables * (c + 1); ++i) {
      const double difference =
          euler_.mesh().volume[c] * (forward * (next[i] - now[i]) + backward * (now[i] - before[i])) + rate[i];
      sum += difference * difference;
    }
  petsc(VecRestoreArrayRead(stages_.back(), &next));
  petsc(VecRestoreArrayRead(state_.q, &now));
  petsc(VecRestoreArrayRead(state_.previous, &before));
  petsc(VecRestoreArrayRead(rates_[0], &rate));
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, euler_.mesh().comm);
  return 6 * std::sqrt(sum) / (dt_ * state_.last_step);
}

/// The residual that changes the step by truncation_fraction of what the scheme's own error does, (1 + 3w)/12 Δt² V d³q/dt³
/// with w of BDF2; never more than a fiftieth of the rate of change: what is left over looks like a truncation error, too, and
/// would excuse more of itself in the next step. In a sound flow the first is 0.0015 to 0.012 of the rate (steps of 5° to 20°).
double FlowSolver::good_enough(double rate) const {
  constexpr double kLargest = 0.02;
  const double truncation = (1 + 3 * bdf2_weight()) / 12 * dt_ * dt_ * state_.third;
  return std::min(options_.truncation_fraction * truncation, kLargest * rate);
}

/// out = q_n − Δt/V Σ_j coefficients_j R_j
void FlowSolver::explicit_state(const double* coefficients, int stages, double dt, Vec out) {
  petsc(VecSet(out, 0.0));
  for (int j = 0; j < stages; ++j)
    if (coefficients[j] != 0) petsc(VecAXPY(out, -dt * coefficients[j], rates_[j]));
  double* v = nullptr;
  petsc(VecGetArray(out, &v));
  for (mesh::Index c = 0; c < euler_.mesh().n_owned; ++c)
    for (int k = 0; k < kVariables; ++k) v[5 * c + k] /= euler_.mesh().volume[c];
  petsc(VecRestoreArray(out, &v));
  petsc(VecAXPY(out, 1.0, state_.q));
}

/// Stage i of an implicit scheme; false unless it is converged.
bool FlowSolver::solve_stage(const TimeScheme& scheme, int i, const FrameFunction& frames, int max_newton,
                             int min_iterations) {
  const VecHandle& stage = stages_[stages_.size() - scheme.stages + i];
  StageEquation equation;
  equation.frames = frames(state_.time + scheme.c[i] * dt_);
  const double w = bdf2_weight();
  const Bdf2Coefficients h = w > 0 ? bdf2_coefficients(dt_ / state_.last_step) : Bdf2Coefficients{1, 0, 1};
  equation.combination = {(1 - w + w / h.a) / dt_, (1 - w) * scheme.a[i][i] + w, known_};
  petsc(VecSet(known_, 0.0));
  add_times_volume(euler_.mesh(), -(1 - w + w * h.h0 / h.a) / dt_, state_.q, known_);
  if (w > 0) add_times_volume(euler_.mesh(), -w * h.h1 / h.a / dt_, state_.previous, known_);
  for (int j = 0; j < i; ++j)
    if (scheme.a[i][j] != 0) petsc(VecAXPY(known_, (1 - w) * scheme.a[i][j], rates_[j]));
  report_.stages.push_back(stage_solver_->solve(equation, stage, scales_[i], max_newton, min_iterations));
  const StageReport& report = report_.stages.back();
  scales_[i].rate = std::max(scales_[i].rate, report.iterations.front().residual);
  scales_[i].before = report.iterations.back().residual;
  report_.failed = report_.failed || report.failed;
  if (!report.converged) report_.reason = report.reason;
  rate_factor_ = equation.combination.rate;
  const bool used_later = i + 1 < scheme.stages;
  if (used_later && !report_.failed) {
    euler_.residual(stage, equation.frames, rates_[i]);
    petsc(VecAXPY(rates_[i], -1 / rate_factor_, stage_solver_->left()));
  }
  return report.converged;
}

/// Whether the preconditioner is to be made anew for a step of this size.
bool FlowSolver::stale(double dt) const {
  constexpr double kStretch = 1.25;  // of the time step
  constexpr int kMaking = 5;         // Krylov iterations take as long as making it
  if (!report_.accepted || jacobian_.dt == 0 || state_.step - jacobian_.step >= options_.jacobian_lag) return true;
  if (dt > kStretch * jacobian_.dt || jacobian_.dt > kStretch * dt) return true;
  return jacobian_.excess >= kMaking;
}

/// Adds up what the preconditioner's age costs, in Krylov iterations of each step's first linear solve: the cheapest time to
/// make it anew is when that is what making it costs.
void FlowSolver::note_krylov() {
  if (report_.stages.empty() || report_.stages.front().iterations.size() < 2) return;
  const int now = report_.stages.front().iterations[1].krylov;
  if (jacobian_.fresh < 0) jacobian_.fresh = now;
  jacobian_.excess += std::max(0, now - jacobian_.fresh);
}

void FlowSolver::predict(double dt, const Frames& now, Vec out) const {
  constexpr int kImpulse = 6;  // an impulsive start does not go on as it began
  const bool starting = state_.step < std::min(kImpulse, options_.start_steps);
  if (!options_.extrapolate || state_.last_step == 0 || starting)
    petsc(VecCopy(state_.q, out));
  else
    extend(euler_, state_, now, dt, out);
}

void FlowSolver::begin(const FrameFunction& frames, double dt) {
  const TimeScheme& scheme = current_scheme();
  if (stage_solver_ && stale(dt)) {
    stage_solver_->renew();
    jacobian_ = {.dt = dt, .step = state_.step};
  }
  dt_ = dt;
  report_ = {};
  const double rate = scheme.implicit ? rate_norm() : 0;
  scales_.assign(scheme.stages, {.rate = rate, .good_enough = good_enough(rate)});
  const bool starts_at_known = scheme.a[0][0] == 0;
  const Frames now = frames(state_.time);
  if (starts_at_known) {
    euler_.residual(state_.q, now, rates_[0]);
    if (state_.remainder) petsc(VecAXPY(rates_[0], -1.0, state_.remainder));
  }
  for (int i = starts_at_known ? 1 : 0; scheme.implicit && i < scheme.stages; ++i)
    predict(scheme.c[i] * dt, now, stages_[stages_.size() - scheme.stages + i]);
}

void FlowSolver::iterate_explicit(const TimeScheme& scheme, const FrameFunction& frames) {
  const Vec stage = stages_.back();
  for (int i = 1; i <= scheme.stages; ++i) {
    explicit_state(i < scheme.stages ? scheme.a[i] : scheme.b, i, dt_, stage);
    if (!euler_.is_physical(stage)) {
      report_.failed = true;
      report_.reason = "negative density or pressure in an explicit stage";
      return;
    }
    if (i < scheme.stages) euler_.residual(stage, frames(state_.time + scheme.c[i] * dt_), rates_[i]);
  }
  report_.accepted = true;
}

const StepReport& FlowSolver::iterate(const FrameFunction& frames, int max_newton, int min_iterations) {
  const TimeScheme& scheme = current_scheme();
  report_.accepted = report_.failed = false;
  report_.reason.clear();
  if (!scheme.implicit) {
    iterate_explicit(scheme, frames);
    return report_;
  }
  bool converged = true;
  for (int i = scheme.a[0][0] == 0 ? 1 : 0; i < scheme.stages && !report_.failed; ++i)
    converged = solve_stage(scheme, i, frames, max_newton, min_iterations) && converged;
  report_.accepted = converged;
  return report_;
}

void FlowSolver::accept() {
  state_.third = third_derivative();
  note_krylov();
  // The error A⁻¹F that Newton's method leaves in a stiff cell, times the Jacobian that R(q) has there, would come back in the next
  // step with the other sign. The rate that obeys the step's equation, R(q) − F over R's factor, hardly knows it (Shampine, SIAM J.
  // Sci. Stat. Comput. 1 (1980) 103; Hairer and Wanner, Solving Ordinary Differential Equations II, section IV.8).
  if (state_.remainder) petsc(VecAXPBY(state_.remainder, 1 / rate_factor_, 0.0, stage_solver_->left()));
  if (state_.earlier) {
    std::swap(state_.earlier, state_.previous);
    state_.step_before = state_.last_step;
  }
  std::swap(state_.previous, state_.q);
  std::swap(state_.q, stages_.back());
  state_.time += dt_;
  state_.last_step = dt_;
  ++state_.step;
}

StepReport FlowSolver::advance(const FrameFunction& frames, double dt) {
  begin(frames, dt);
  iterate(frames);
  if (report_.accepted) accept();
  return report_;
}

}  // namespace windhover::fluid
