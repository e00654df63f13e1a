// One implicit stage by Newton–Krylov (SNES, flexible GMRES).
#pragma once
#include "fluid/interface_coupling.h"
#include "fluid/last_correction.h"
#include "fluid/preconditioner.h"
#include "fluid/stage_solver.h"
#include "fluid/zone_turn.h"

namespace windhover::fluid {

struct NewtonOptions {
  const Preconditioner* preconditioner = &kPreconditioners[0];
  int ilu_levels = 0;
  bool exact_jacobian = true;     ///< products by forward mode, else by differences
  double tolerance = 1e-3;        ///< of the residual, relative to the rate of change of the flow
  int max_iterations = 12;
  bool eisenstat_walker = true;
  double krylov_tolerance = 0.1;  ///< without Eisenstat–Walker
  int krylov_iterations = 200;
  int krylov_restart = 30;
};

class NewtonKrylov : public StageSolver {
 public:
  NewtonKrylov(EulerOperator& euler, const NewtonOptions& options);
  NewtonKrylov(const NewtonKrylov&) = delete;
  NewtonKrylov& operator=(const NewtonKrylov&) = delete;

  StageReport solve(const StageEquation& equation, Vec q, const StageScale& scale, int max_newton, int min_iterations) override;
  /// The preconditioner.
  void renew() override { rebuild_ = true; }

 private:
  double forcing() const;
  static PetscErrorCode set_forcing(SNES, PetscInt iteration);
  static PetscErrorCode form_function(SNES, Vec x, Vec f, void* self);
  static PetscErrorCode form_jacobian(SNES, Vec x, Mat j, Mat p, void* self);
  static PetscErrorCode enter_axes(KSP, Vec b, Vec x, void* self);
  static PetscErrorCode leave_axes(KSP, Vec b, Vec x, void* self);
  static PetscErrorCode multiply(Mat, Vec x, Vec y);
  static PetscErrorCode limit_update(SNESLineSearch, Vec x, Vec y, PetscBool* changed, void* self);
  static PetscErrorCode test_convergence(SNES, PetscInt, PetscReal, PetscReal, PetscReal, SNESConvergedReason*, void* self);

  EulerOperator& euler_;
  NewtonOptions options_;
  CallbackGuard guard_;
  VecHandle residual_, work_;
  MatHandle product_;     ///< in the axes of the preconditioner
  MatHandle difference_;  ///< product by differences, inertial axes
  std::optional<BlockJacobian> jacobian_;
  std::optional<InterfaceCoupling> coupling_;  ///< what jacobian_ lacks
  MatHandle converted_;  ///< jacobian_ in the preconditioner's own storage, when that is not BAIJ
  Frames made_in_;   ///< where the zones were when the preconditioner was made
  ZoneTurn turned_;  ///< since then; linear systems are solved in the axes from before
  SnesHandle snes_;
  std::optional<LastCorrection> last_correction_;  ///< where Newton's method may judge a linear solve
  RoundOff round_off_;
  const StageEquation* equation_ = nullptr;
  StageScale scale_;
  double target_ = 0;
  double forcing_ = 0;  ///< by how much the linear residual was last asked to fall
  int max_iterations_ = 0, min_iterations_ = 0;
  double started_ = 0;
  int krylov_before_ = 0;
  bool rebuild_ = true;
  StageReport report_;
};

}  // namespace windhover::fluid
