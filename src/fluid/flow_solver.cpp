#include "fluid/flow_solver.h"

#include <cmath>

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
  if (options_.scheme->implicit) newton_.emplace(euler, options.newton);
  state_.q = euler.make_vector();
  state_.previous = euler.make_vector();
  stage_ = euler.make_vector();
  known_ = euler.make_vector();
  const int kept = options_.scheme->stages - (options_.scheme->implicit ? 1 : 0);
  for (int j = 0; j < kept; ++j) rates_.push_back(euler.make_vector());
}

const TimeScheme& FlowSolver::current_scheme() const {
  static const TimeScheme& backward_euler = time_scheme("backward_euler");
  const bool starting = options_.scheme->implicit && state_.step < options_.start_steps;
  const bool no_history = options_.scheme->bdf2 && state_.last_step == 0;
  return starting || no_history ? backward_euler : *options_.scheme;
}

/// Norm of V (q_n − q_{n−1}) / Δt: how fast the flow changes, what Newton's residual is compared with.
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

bool FlowSolver::is_physical(Vec q) const {
  const double* v = nullptr;
  petsc(VecGetArrayRead(q, &v));
  int good = 1;
  for (mesh::Index c = 0; c < euler_.mesh().n_owned && good; ++c)
    good = v[5 * c] > 0 && primitive(v + 5 * c, euler_.model().gamma).p > 0;  // false for NaN, too
  petsc(VecRestoreArrayRead(q, &v));
  MPI_Allreduce(MPI_IN_PLACE, &good, 1, MPI_INT, MPI_MIN, euler_.mesh().comm);
  return good;
}

/// out = q_n + fraction Δt (q_n − q_{n−1}) / Δt_{n−1}, or q_n where that would not be a gas.
void FlowSolver::predict(double fraction, double dt, Vec out) const {
  petsc(VecCopy(state_.q, out));
  if (!options_.extrapolate || state_.last_step == 0) return;
  const double r = fraction * dt / state_.last_step;
  petsc(VecAXPBY(out, -r, 1.0 + r, state_.previous));
  if (!is_physical(out)) petsc(VecCopy(state_.q, out));
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

/// Stage i into stage_; false when it failed.
bool FlowSolver::solve_stage(const TimeScheme& scheme, int i, const FrameFunction& frames, double dt, StepReport& report) {
  if (scheme.a[i][i] == 0) {
    explicit_state(scheme.a[i], i, dt, stage_);
    if (is_physical(stage_)) return true;
    report.reason = "negative density or pressure in an explicit stage";
    return false;
  }
  StageEquation equation;
  equation.combination = {1.0 / dt, scheme.a[i][i], known_};
  equation.frames = frames(state_.time + scheme.c[i] * dt);
  petsc(VecSet(known_, 0.0));
  if (scheme.bdf2) {
    const Bdf2Coefficients h = bdf2_coefficients(dt / state_.last_step);
    equation.combination.rate = h.a;
    add_times_volume(euler_.mesh(), -h.h0 / dt, state_.q, known_);
    add_times_volume(euler_.mesh(), -h.h1 / dt, state_.previous, known_);
  } else {
    add_times_volume(euler_.mesh(), -1.0 / dt, state_.q, known_);
  }
  for (int j = 0; j < i; ++j)
    if (scheme.a[i][j] != 0) petsc(VecAXPY(known_, scheme.a[i][j], rates_[j]));
  predict(scheme.c[i], dt, stage_);
  const double reference = rate_norm();
  report.stages.push_back(newton_->solve(equation, stage_, reference));
  if (!report.stages.back().converged) report.reason = "Newton: " + report.stages.back().reason;
  return report.stages.back().converged;
}

StepReport FlowSolver::advance(const FrameFunction& frames, double dt) {
  const TimeScheme& scheme = current_scheme();
  if (newton_ && state_.step % options_.jacobian_lag == 0) newton_->rebuild_preconditioner();
  StepReport report;
  for (int i = 0; i < scheme.stages; ++i) {
    if (!solve_stage(scheme, i, frames, dt, report)) {
      if (newton_) newton_->rebuild_preconditioner();
      return report;
    }
    const bool used_later = !scheme.implicit || i + 1 < scheme.stages;
    if (used_later) euler_.residual(stage_, frames(state_.time + scheme.c[i] * dt), rates_[i]);
  }
  if (!scheme.implicit) {
    explicit_state(scheme.b, scheme.stages, dt, stage_);
    if (!is_physical(stage_)) {
      report.reason = "negative density or pressure after an explicit step";
      return report;
    }
  }
  std::swap(state_.previous, state_.q);
  petsc(VecCopy(stage_, state_.q));
  state_.time += dt;
  state_.last_step = dt;
  ++state_.step;
  report.accepted = true;
  return report;
}

}  // namespace windhover::fluid
