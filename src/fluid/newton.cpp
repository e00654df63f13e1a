#include "fluid/newton.h"

#include <algorithm>
#include <cmath>

#include "fluid/line_search.h"

namespace windhover::fluid {
namespace {

// Added to the speed of each wave in the preconditioner's dissipation, in the far field's speed of sound: in small cells what
// the flow carries turns round from step to step, and a matrix from before would take it from the wrong side.
constexpr double kDamping = 0.05;

/// Products in single precision are off by 3e-7 along a random direction; they serve where the residual is to fall by no more
/// than this.
constexpr double kSinglePrecision = 1e-3;

constexpr double kLeastFraction = 0.2;  // density and pressure keep at least this much of themselves in one update

bool keeps_positive(const double* q, const double* change, double fraction, double gamma) {
  double next[kVariables];
  for (int k = 0; k < kVariables; ++k) next[k] = q[k] - fraction * change[k];
  return next[0] > kLeastFraction * q[0] && primitive(next, gamma).p > kLeastFraction * primitive(q, gamma).p;
}

}  // namespace

NewtonKrylov::NewtonKrylov(EulerOperator& euler, const NewtonOptions& options)
    : euler_(euler), options_(options), round_off_(euler) {
  const mesh::Mesh& mesh = euler.mesh();
  residual_ = euler.make_vector();
  euler.keep_rates();
  petsc(SNESCreate(mesh.comm, snes_.out()));
  petsc(SNESSetOptionsPrefix(snes_, "fluid_"));
  petsc(SNESSetFunction(snes_, residual_, form_function, this));
  const PetscInt n = kVariables * mesh.n_owned;
  petsc(MatCreateShell(mesh.comm, n, n, PETSC_DETERMINE, PETSC_DETERMINE, this, product_.out()));
  petsc(MatShellSetOperation(product_, MATOP_MULT, reinterpret_cast<void (*)()>(multiply)));
  if (!options_.exact_jacobian) {
    petsc(MatCreateSNESMF(snes_, difference_.out()));
    work_ = euler.make_vector();
  }
  Mat for_preconditioner = product_;
  if (options_.preconditioner->assembled) {
    jacobian_.emplace(mesh);
    for_preconditioner = jacobian_->matrix();
    if (options_.preconditioner->point_matrix) {
      petsc(MatConvert(jacobian_->matrix(), MATAIJ, MAT_INITIAL_MATRIX, converted_.out()));
      for_preconditioner = converted_;
    }
  }
  if (options_.preconditioner->coupled && !euler.sliding_faces().empty()) coupling_.emplace(euler);
  petsc(SNESSetJacobian(snes_, product_, for_preconditioner, form_jacobian, this));
  petsc(SNESSetType(snes_, SNESNEWTONLS));
  petsc(SNESSetConvergenceTest(snes_, test_convergence, this, nullptr));
  petsc(SNESSetMaxLinearSolveFailures(snes_, options_.max_iterations));  // Newton judges, not the inner solve
  use_parabolic_backtracking(snes_);
  SNESLineSearch search = nullptr;
  petsc(SNESGetLineSearch(snes_, &search));
  petsc(SNESLineSearchSetPreCheck(search, limit_update, this));
  petsc(SNESSetApplicationContext(snes_, this));
  petsc(SNESSetUpdate(snes_, set_forcing));
  KSP ksp = nullptr;
  PC pc = nullptr;
  petsc(SNESGetKSP(snes_, &ksp));
  petsc(KSPSetType(ksp, KSPFGMRES));
  petsc(KSPGMRESSetRestart(ksp, options_.krylov_restart));
  petsc(KSPSetTolerances(ksp, options_.krylov_tolerance, 0, PETSC_DEFAULT, options_.krylov_iterations));
  if (options_.eisenstat_walker) last_correction_.emplace(ksp);
  petsc(KSPSetPreSolve(ksp, enter_axes, this));
  petsc(KSPSetPostSolve(ksp, leave_axes, this));
  petsc(KSPGetPC(ksp, &pc));
  options_.preconditioner->set_up(pc, options_.ilu_levels, coupling_ ? &*coupling_ : nullptr);
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
  krylov_before_ = 0;
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

PetscErrorCode NewtonKrylov::set_forcing(SNES snes, PetscInt) {
  void* context = nullptr;
  const PetscErrorCode code = SNESGetApplicationContext(snes, &context);
  if (code) return code;
  auto& self = *static_cast<NewtonKrylov*>(context);
  return self.guard_.run([&] {
    KSP ksp = nullptr;
    petsc(SNESGetKSP(snes, &ksp));
    self.forcing_ = self.forcing();
    petsc(KSPSetTolerances(ksp, self.forcing_, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT));
  });
}

PetscErrorCode NewtonKrylov::form_function(SNES, Vec x, Vec f, void* context) {
  auto& self = *static_cast<NewtonKrylov*>(context);
  return self.guard_.run([&] { self.euler_.residual(x, self.equation_->frames, f, self.equation_->combination); });
}

PetscErrorCode NewtonKrylov::form_jacobian(SNES, Vec x, Mat j, Mat, void* context) {
  auto& self = *static_cast<NewtonKrylov*>(context);
  return self.guard_.run([&] {
    const StageEquation& e = *self.equation_;
    if (self.jacobian_ && self.rebuild_) {
      self.euler_.first_order_jacobian(x, e.frames, e.combination.rate, e.combination.mass, *self.jacobian_, kDamping);
      if (self.converted_) {
        Mat reused = self.converted_;
        petsc(MatConvert(self.jacobian_->matrix(), MATAIJ, MAT_REUSE_MATRIX, &reused));
      }
      self.rebuild_ = false;
      self.made_in_ = e.frames;
    }
    if (self.jacobian_) self.turned_ = ZoneTurn(self.made_in_, e.frames);
    if (self.coupling_) self.coupling_->renew(x, e.frames, e.combination.rate, self.turned_);
    if (self.options_.exact_jacobian) self.euler_.linearize(x, e.frames);
    for (const Mat m : {j, static_cast<Mat>(self.difference_)}) {
      if (!m) continue;
      petsc(MatAssemblyBegin(m, MAT_FINAL_ASSEMBLY));
      petsc(MatAssemblyEnd(m, MAT_FINAL_ASSEMBLY));
    }
    if (self.difference_) petsc(MatMFFDSetBase(self.difference_, x, nullptr));  // SNES's own F is turned (enter_axes)
  });
}

PetscErrorCode NewtonKrylov::enter_axes(KSP, Vec b, Vec, void* context) {
  auto& self = *static_cast<NewtonKrylov*>(context);
  return self.guard_.run([&] {
    if (!self.turned_.none()) self.turned_.back(self.euler_.mesh(), b);
  });
}

PetscErrorCode NewtonKrylov::leave_axes(KSP ksp, Vec b, Vec x, void* context) {
  auto& self = *static_cast<NewtonKrylov*>(context);
  return self.guard_.run([&] {
    if (self.last_correction_) self.last_correction_->apply(ksp, b, x);
    if (self.turned_.none()) return;
    self.turned_.forth(self.euler_.mesh(), b);
    self.turned_.forth(self.euler_.mesh(), x);
  });
}

PetscErrorCode NewtonKrylov::multiply(Mat matrix, Vec x, Vec y) {
  void* context = nullptr;
  PetscErrorCode code = MatShellGetContext(matrix, &context);
  if (code) return code;
  auto& self = *static_cast<NewtonKrylov*>(context);
  return self.guard_.run([&] {
    if (self.last_correction_) self.last_correction_->note_product(y);
    const ZoneTurn& turned = self.turned_;
    if (self.options_.exact_jacobian) {
      self.euler_.derivative(x, y, {self.equation_->combination.mass, self.equation_->combination.rate}, turned,
                             self.forcing_ >= kSinglePrecision);
      return;
    }
    petsc(VecCopy(x, self.work_));
    if (!turned.none()) turned.forth(self.euler_.mesh(), self.work_);
    petsc(MatMult(self.difference_, self.work_, y));
    if (!turned.none()) turned.back(self.euler_.mesh(), y);
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

PetscErrorCode NewtonKrylov::test_convergence(SNES snes, PetscInt iteration, PetscReal, PetscReal, PetscReal norm,
                                              SNESConvergedReason* reason, void* context) {
  auto& self = *static_cast<NewtonKrylov*>(context);
  return self.guard_.run([&] {
    PetscInt krylov = 0;
    petsc(SNESGetLinearSolveIterations(snes, &krylov));
    self.report_.iterations.push_back(
        {norm, static_cast<int>(krylov) - self.krylov_before_, MPI_Wtime() - self.started_});
    self.krylov_before_ = static_cast<int>(krylov);
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
