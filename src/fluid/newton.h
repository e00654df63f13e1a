// One implicit stage by Newton–Krylov (SNES, flexible GMRES).
#pragma once
#include "fluid/linear_solver.h"

namespace windhover::fluid {

class NewtonKrylov : public StageSolver {
 public:
  NewtonKrylov(EulerOperator& euler, const NewtonOptions& options);
  NewtonKrylov(const NewtonKrylov&) = delete;
  NewtonKrylov& operator=(const NewtonKrylov&) = delete;

  StageReport solve(const StageEquation& equation, Vec q, const StageScale& scale, int max_newton, int min_iterations) override;
  Vec left() const override { return residual_; }
  /// The preconditioner.
  void renew() override { linear_.renew(); }

 private:
  double forcing() const;
  static PetscErrorCode form_function(SNES, Vec x, Vec f, void* self);
  static PetscErrorCode form_jacobian(SNES, Vec x, Mat j, Mat p, void* self);
  static PetscErrorCode solve_linear(PC, Vec b, Vec x);
  static PetscErrorCode limit_update(SNESLineSearch, Vec x, Vec y, PetscBool* changed, void* self);
  static PetscErrorCode test_convergence(SNES, PetscInt, PetscReal, PetscReal, PetscReal, SNESConvergedReason*, void* self);

  EulerOperator& euler_;
  NewtonOptions options_;
  CallbackGuard guard_;
  LinearSolver linear_;
  VecHandle residual_;
  SnesHandle snes_;
  RoundOff round_off_;
  const StageEquation* equation_ = nullptr;
  StageScale scale_;
  double target_ = 0;
  double forcing_ = 0;  ///< by how much the linear residual was last asked to fall
  int max_iterations_ = 0, min_iterations_ = 0;
  double started_ = 0;
  int krylov_ = 0;  ///< iterations of the last linear solve
  StageReport report_;
};

}  // namespace windhover::fluid
