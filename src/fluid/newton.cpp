#include "fluid/newton.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fluid/line_search.h"

namespace windhover::fluid {
namespace {

constexpr double kLeastFraction = 0.2;  // density and pressure keep at least this much of themselves in one update

bool keeps_positive(const double* q, const double* change, double fraction, double gamma) {
  double next[kVariables];
  for (int k = 0; k < kVariables; ++k) next[k] = q[k] - fraction * change[k];
  return next[0] > kLeastFraction * q[0] && primitive(next, gamma).p > kLeastFraction * primitive(q, gamma).p;
}

}  // namespace

NewtonKrylov::NewtonKrylov(EulerOperator& euler, const NewtonOptions& options)
    : euler_(euler), options_(options), linear_(euler, options), round_off_(euler) {
  residual_ = euler.make_vector();
  euler.keep_rates();
  petsc(SNESCreate(euler.mesh().comm, snes_.out()));
  petsc(SNESSetOptionsPrefix(snes_, "fluid_"));
  petsc(SNESSetFunction(snes_, residual_, form_function, this));
  petsc(SNESSetJacobian(snes_, linear_.product(), linear_.product(), form_jacobian, this));
  petsc(SNESSetType(snes_, SNESNEWTONLS));
  petsc(SNESSetConvergenceTest(snes_, test_convergence, this, nullptr));
  use_parabolic_backtracking(snes_);
  SNESLineSearch search = nullptr;
  petsc(SNESGetLineSearch(snes_, &search));
  petsc(SNESLineSearchSetPreCheck(search, limit_update, this));
  KSP ksp = nullptr;
  PC pc = nullptr;
  petsc(SNESGetKSP(snes_, &ksp));
  petsc(KSPSetOptionsPrefix(ksp, "fluid_linear_solver_"));  // not the one that iterates
  petsc(KSPSetType(ksp, KSPPREONLY));
  petsc(KSPGetPC(ksp, &pc));
  petsc(PCSetType(pc, PCSHELL));
  petsc(PCShellSetContext(pc, this));
  petsc(PCShellSetApply(pc, solve_linear));
  petsc(SNESSetFromOptions(snes_));
}

StageReport NewtonKrylov::solve(const StageEquation& equation, Vec q, const StageScale& scale, int max_newton,
                                int min_iterations) {
  equation_ = &equation;
  max_iterations_ = max_newton > 0 ? max_newton : options_.max_iterations;
  min_iterations_ = min_iterations;
  petsc(SNESSetTolerances(snes_, 0, 0, 0, max_iterations_, PETSC_MAX_INT));
  scale_ = scale;
  report_ = {};
  krylov_ = 0;
  started_ = MPI_Wtime();
  const PetscErrorCode code = SNESSolve(snes_, nullptr, q);
  guard_.rethrow();
  petsc(code);
  SNESConvergedReason reason;
  petsc(SNESGetConvergedReason(snes_, &reason));
  report_.converged = reason > 0;
  report_.failed = reason < 0 && reason != SNES_DIVERGED_MAX_IT;
  if (!report_.converged) report_.reason = std::string("Newton: ") + SNESConvergedReasons[reason];
  for (const auto& i : report_.iterations) report_.krylov += i.krylov;
  return report_;
}

/// Eisenstat and Walker, SIAM J. Sci. Comput. 17 (1996) 16, choice 2 with its safeguard, and Kelley's against solving for
/// more than is left to Newton's target (Iterative Methods for Linear and Nonlinear Equations, 1995, eq. 6.20). PETSc's
/// Eisenstat–Walker lacks the latter: a residual one tenth above the target was brought a hundred times below. The first
/// iteration goes for the target, by kFirst at most: from an extrapolated start the equation is almost linear.
double NewtonKrylov::forcing() const {
  constexpr double kFirst = 0.001, kGamma = 0.9, kMemory = 0.1, kLargest = 0.3, kOfTarget = 0.9;
  const auto& done = report_.iterations;
  if (!options_.eisenstat_walker) return options_.krylov_tolerance;
  const double now = done.back().residual;
  double convergence = kFirst;
  if (done.size() > 1) {
    const double ratio = now / done[done.size() - 2].residual, last = kGamma * forcing_ * forcing_;
    convergence = std::max(kGamma * ratio * ratio, last > kMemory ? last : 0);
  }
  return std::min(std::max(convergence, kOfTarget * target_ / now), kLargest);
}

PetscErrorCode NewtonKrylov::form_function(SNES, Vec x, Vec f, void* context) {
  auto& self = *static_cast<NewtonKrylov*>(context);
  return self.guard_.run([&] { self.euler_.residual(x, self.equation_->frames, f, self.equation_->combination); });
}

PetscErrorCode NewtonKrylov::form_jacobian(SNES, Vec x, Mat, Mat, void* context) {
  auto& self = *static_cast<NewtonKrylov*>(context);
  return self.guard_.run([&] { self.linear_.linearize(x, *self.equation_); });
}

/// Newton judges what is left of b; what is of no use, it shall see.
PetscErrorCode NewtonKrylov::solve_linear(PC pc, Vec b, Vec x) {
  void* context = nullptr;
  if (const PetscErrorCode code = PCShellGetContext(pc, &context)) return code;
  auto& self = *static_cast<NewtonKrylov*>(context);
  return self.guard_.run([&] {
    self.forcing_ = self.forcing();
    const LinearSolver::Outcome outcome = self.linear_.solve(b, x, self.forcing_);
    self.krylov_ = outcome.iterations;
    if (!outcome.usable) petsc(VecSet(x, std::numeric_limits<double>::quiet_NaN()));
  });
}

PetscErrorCode NewtonKrylov::limit_update(SNESLineSearch, Vec x, Vec y, PetscBool* changed, void* context) {
  auto& self = *static_cast<NewtonKrylov*>(context);
  return self.guard_.run([&] {
    const double* q = nullptr;
    double* change = nullptr;
    int limited = 0;
    petsc(VecGetArrayRead(x, &q));
    petsc(VecGetArray(y, &change));
    for (mesh::Index c = 0; c < self.euler_.mesh().n_owned; ++c) {
      double fraction = 1.0;
      while (fraction > 1e-6 && !keeps_positive(q + 5 * c, change + 5 * c, fraction, self.euler_.model().gamma))
        fraction *= 0.5;
      if (fraction == 1.0) continue;
      limited = 1;
      for (int k = 0; k < kVariables; ++k) change[5 * c + k] *= fraction;
    }
    petsc(VecRestoreArrayRead(x, &q));
    petsc(VecRestoreArray(y, &change));
    MPI_Allreduce(MPI_IN_PLACE, &limited, 1, MPI_INT, MPI_MAX, self.euler_.mesh().comm);
    *changed = limited ? PETSC_TRUE : PETSC_FALSE;
  });
}

PetscErrorCode NewtonKrylov::test_convergence(SNES, PetscInt iteration, PetscReal, PetscReal, PetscReal norm,
                                              SNESConvergedReason* reason, void* context) {
  auto& self = *static_cast<NewtonKrylov*>(context);
  return self.guard_.run([&] {
    self.report_.iterations.push_back({norm, std::exchange(self.krylov_, 0), MPI_Wtime() - self.started_});
    const double floor = self.round_off_(self.equation_->combination);
    if (iteration == 0) {
      const auto& scale = self.scale_;
      self.target_ = scale.target(self.options_.tolerance * std::max(norm, scale.rate), floor);
      if (scale.unmoved(norm, self.target_)) self.min_iterations_ = 0;
    }
    *reason = SNES_CONVERGED_ITERATING;
    if (!std::isfinite(norm))
      *reason = SNES_DIVERGED_FNORM_NAN;
    else if (norm <= (iteration < self.min_iterations_ ? floor : self.target_))
      *reason = SNES_CONVERGED_FNORM_RELATIVE;
    else if (norm > kDivergence * std::max(self.report_.iterations.front().residual, self.scale_.rate))
      *reason = SNES_DIVERGED_DTOL;
    else if (iteration >= self.max_iterations_)
      *reason = SNES_DIVERGED_MAX_IT;
  });
}

}  // namespace windhover::fluid
