#include "fluid/linear_solver.h"

#include <algorithm>

#include "fluid/block_ilu_pc.h"
#include "fluid/single_vector.h"

namespace windhover::fluid {
namespace {

// Added to the speed of each wave in the preconditioner's dissipation, in the far field's speed of sound: in small cells what
// the flow carries turns round from step to step, and a matrix from before would take it from the wrong side.
constexpr double kDamping = 0.05;

/// Products in single precision are off by 3e-7 along a random direction; they serve where the residual is to fall by no more
/// than this.
constexpr double kSinglePrecision = 1e-3;

constexpr int kReach = 2;  // layers of cells that a cell acts on, but for little: through gradients

template <class Object>
bool is_of_type(Object object, const char* type) {
  PetscBool same = PETSC_FALSE;
  petsc(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(object), type, &same));
  return same;
}

LinearSolver::Outcome outcome_of(KSP ksp) {
  PetscInt iterations = 0;
  KSPConvergedReason reason;
  petsc(KSPGetIterationNumber(ksp, &iterations));
  petsc(KSPGetConvergedReason(ksp, &reason));
  return {iterations, reason != KSP_DIVERGED_NANORINF && reason != KSP_DIVERGED_PC_FAILED};
}

}  // namespace

LinearSolver::LinearSolver(EulerOperator& euler, const NewtonOptions& options) : euler_(euler), options_(options) {
  const mesh::Mesh& mesh = euler.mesh();
  const PetscInt n = kVariables * mesh.n_owned;
  petsc(MatCreateShell(mesh.comm, n, n, PETSC_DETERMINE, PETSC_DETERMINE, this, product_.out()));
  petsc(MatShellSetOperation(product_, MATOP_MULT, reinterpret_cast<void (*)()>(multiply)));
  if (!options_.exact_jacobian) {
    petsc(MatCreateMFFD(mesh.comm, n, n, PETSC_DETERMINE, PETSC_DETERMINE, difference_.out()));
    petsc(MatMFFDSetFunction(difference_, residual, this));
    petsc(MatSetUp(difference_));
    work_ = euler.make_vector();
  }
  right_ = euler.make_vector();
  if (options_.preconditioner->assembled) {
    jacobian_.emplace(mesh);
    if (options_.preconditioner->point_matrix)
      petsc(MatConvert(jacobian_->matrix(), MATAIJ, MAT_INITIAL_MATRIX, converted_.out()));
  }
  if (options_.preconditioner->coupled && !euler.sliding_faces().empty()) coupling_.emplace(euler);
  set_up_double();
  if (options_.exact_jacobian && options_.preconditioner->apply_single) set_up_single();
}

void LinearSolver::use_options(KSP ksp, std::optional<LastCorrection>& last) {
  petsc(KSPSetOptionsPrefix(ksp, "fluid_"));
  petsc(KSPSetType(ksp, KSPFGMRES));
  petsc(KSPGMRESSetRestart(ksp, options_.krylov_restart));
  petsc(KSPSetTolerances(ksp, PETSC_DEFAULT, 0, PETSC_DEFAULT, options_.krylov_iterations));
  if (options_.eisenstat_walker) last.emplace(ksp);
}

Mat LinearSolver::for_preconditioner() const {
  if (converted_) return converted_;
  return jacobian_ ? jacobian_->matrix() : Mat(product_);
}

void LinearSolver::set_up_double() {
  PC pc = nullptr;
  petsc(KSPCreate(euler_.mesh().comm, ksp_.out()));
  petsc(KSPSetOperators(ksp_, product_, for_preconditioner()));
  use_options(ksp_, last_correction_);
  petsc(KSPGetPC(ksp_, &pc));
  options_.preconditioner->set_up(pc, options_.ilu_levels, coupling_ ? &*coupling_ : nullptr);
  petsc(KSPSetFromOptions(ksp_));
}

/// Unless PETSc's options ask for another method or preconditioner.
void LinearSolver::set_up_single() {
  PC pc = nullptr;
  petsc(KSPGetPC(ksp_, &pc));
  if (!is_of_type<KSP>(ksp_, KSPFGMRES) || !is_of_type(pc, PCSHELL)) return;
  const auto product = [this](Vec x, Vec y) {
    if (last_correction_single_) last_correction_single_->note_product(y);
    const Combination& c = equation_->combination;
    euler_.derivative(single_values_read(x), single_values(y), {c.mass, c.rate}, turned_);
  };
  const auto precondition = [this, pc](Vec x, Vec y) {
    this->precondition(pc, single_values_read(x), single_values(y));
  };
  single_.emplace(euler_.mesh().comm, kVariables * euler_.mesh().n_owned, product, precondition);
  use_options(single_->ksp(), last_correction_single_);
  petsc(KSPSetFromOptions(single_->ksp()));
  if (coupling_) euler_.set_near_interfaces(kNearInterfaces + kReach);
}

/// Where the residual is still many times its goal, most of it stands at interfaces, whose faces exchange their neighbours in each
/// step: x = x₁ + M⁻¹ (b − A x₁), x₁ near interfaces alone, with exact products there. Not where the whole solve takes the two
/// iterations that it takes in any case (LastCorrection judges from two). A last correction begins as the iteration before it did,
/// by which LastCorrection judged.
void LinearSolver::precondition(PC pc, const float* b, float* x) {
  constexpr double kMany = 8, kTwoIterations = 1.0 / 25;
  const Preconditioner& preconditioner = *options_.preconditioner;
  PetscReal residual = 0;
  KSPConvergedReason reason;
  petsc(KSPGetResidualNorm(single_->ksp(), &residual));
  petsc(KSPGetConvergedReason(single_->ksp(), &reason));
  if (reason == KSP_CONVERGED_ITERATING) near_first_ = coupling_ && fall_ <= kTwoIterations && residual >= kMany * fall_;
  if (!near_first_) {
    preconditioner.apply_single(pc, b, x);
    return;
  }
  const size_t n = kVariables * euler_.mesh().n_owned;
  const Combination& c = equation_->combination;
  near_.resize(n);  // zero but near interfaces
  preconditioner.apply_near_interfaces(pc, b, near_.data());
  euler_.derivative_near_interfaces(near_.data(), x, {c.mass, c.rate}, turned_);
  rest_.assign(b, b + n);
  for (const mesh::Range& zone : euler_.near_interfaces())
    for (size_t i = kVariables * zone.begin; i < size_t(kVariables) * zone.end; ++i) rest_[i] -= x[i];
  preconditioner.apply_single(pc, rest_.data(), x);
  for (const mesh::Range& zone : euler_.near_interfaces())
    for (size_t i = kVariables * zone.begin; i < size_t(kVariables) * zone.end; ++i) x[i] += near_[i];
}

void LinearSolver::linearize(Vec q, const StageEquation& equation) {
  equation_ = &equation;
  const auto& [combination, frames] = equation;
  if (jacobian_ && rebuild_) {
    euler_.first_order_jacobian(q, frames, combination.rate, combination.mass, *jacobian_, kDamping);
    if (converted_) {
      Mat reused = converted_;
      petsc(MatConvert(jacobian_->matrix(), MATAIJ, MAT_REUSE_MATRIX, &reused));
    }
    rebuild_ = false;
    made_in_ = frames;
  }
  if (jacobian_) turned_ = ZoneTurn(made_in_, frames);
  if (coupling_) coupling_->renew(q, frames, combination.rate, turned_);
  if (options_.exact_jacobian) euler_.linearize(q, frames);
  for (const Mat m : {static_cast<Mat>(product_), static_cast<Mat>(difference_)}) {
    if (!m) continue;
    petsc(MatAssemblyBegin(m, MAT_FINAL_ASSEMBLY));
    petsc(MatAssemblyEnd(m, MAT_FINAL_ASSEMBLY));
  }
  if (difference_) petsc(MatMFFDSetBase(difference_, q, nullptr));
  petsc(KSPSetOperators(ksp_, product_, for_preconditioner()));  // or PETSc would not look whether they have changed
}

LinearSolver::Outcome LinearSolver::solve(Vec b, Vec x, double fall) {
  fall_ = fall;
  return single_ && fall >= kSinglePrecision ? solve_single(b, x) : solve_double(b, x);
}

LinearSolver::Outcome LinearSolver::solve_double(Vec b, Vec x) {
  petsc(VecCopy(b, right_));
  if (!turned_.none()) turned_.back(euler_.mesh(), right_);
  petsc(KSPSetTolerances(ksp_, fall_, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT));
  const PetscErrorCode code = KSPSolve(ksp_, right_, x);
  guard_.rethrow();
  petsc(code);
  if (last_correction_) last_correction_->apply(ksp_, right_, x);
  if (!turned_.none()) turned_.forth(euler_.mesh(), x);
  return outcome_of(ksp_);
}

/// Of b over its norm, which is as good as any in floats.
LinearSolver::Outcome LinearSolver::solve_single(Vec b, Vec x) {
  const mesh::Mesh& mesh = euler_.mesh();
  const PetscInt n = kVariables * mesh.n_owned;
  const Vec right = single_->right_side(), solution = single_->solution();
  const double* from = nullptr;
  double *to = nullptr, size = 0;
  PC pc = nullptr;
  PCFailedReason failed;
  petsc(KSPGetPC(ksp_, &pc));
  petsc(PCSetUp(pc));  // its own KSP would make vectors that may never be used
  petsc(PCGetFailedReasonRank(pc, &failed));  // the same on all ranks
  if (failed) return {0, false};
  petsc(VecNorm(b, NORM_2, &size));
  const double over = size > 0 ? 1 / size : 0;
  petsc(VecGetArrayRead(b, &from));
  std::transform(from, from + n, single_values(right), [over](double v) { return static_cast<float>(v * over); });
  petsc(VecRestoreArrayRead(b, &from));
  if (!turned_.none()) turned_.back(mesh, single_values(right));
  petsc(KSPSetTolerances(single_->ksp(), fall_, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT));
  const PetscErrorCode code = KSPSolve(single_->ksp(), right, solution);
  single_->rethrow();
  petsc(code);
  if (last_correction_single_) last_correction_single_->apply(single_->ksp(), right, solution);
  if (!turned_.none()) turned_.forth(mesh, single_values(solution));
  petsc(VecGetArrayWrite(x, &to));
  std::transform(single_values_read(solution), single_values_read(solution) + n, to, [size](float v) { return size * v; });
  petsc(VecRestoreArrayWrite(x, &to));
  return outcome_of(single_->ksp());
}

PetscErrorCode LinearSolver::multiply(Mat matrix, Vec x, Vec y) {
  void* context = nullptr;
  if (const PetscErrorCode code = MatShellGetContext(matrix, &context)) return code;
  auto& self = *static_cast<LinearSolver*>(context);
  return self.guard_.run([&] {
    if (self.last_correction_) self.last_correction_->note_product(y);
    const ZoneTurn& turned = self.turned_;
    if (self.options_.exact_jacobian) {
      const Combination& c = self.equation_->combination;
      self.euler_.derivative(x, y, {c.mass, c.rate}, turned, self.fall_ >= kSinglePrecision);
      return;
    }
    petsc(VecCopy(x, self.work_));
    if (!turned.none()) turned.forth(self.euler_.mesh(), self.work_);
    petsc(MatMult(self.difference_, self.work_, y));
    if (!turned.none()) turned.back(self.euler_.mesh(), y);
  });
}

PetscErrorCode LinearSolver::residual(void* context, Vec x, Vec f) {
  auto& self = *static_cast<LinearSolver*>(context);
  return self.guard_.run([&] { self.euler_.residual(x, self.equation_->frames, f, self.equation_->combination); });
}

}  // namespace windhover::fluid
