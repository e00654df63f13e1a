// The linear systems of Newton's method: exact products, a preconditioner, flexible GMRES (PETSc).
#pragma once
#include <optional>

#include "fluid/interface_coupling.h"
#include "fluid/last_correction.h"
#include "fluid/newton_options.h"
#include "fluid/single_gmres.h"
#include "fluid/stage_solver.h"
#include "fluid/zone_turn.h"

namespace windhover::fluid {

class LinearSolver {
 public:
  /// Options of PETSc's solvers begin with fluid_.
  LinearSolver(EulerOperator& euler, const NewtonOptions& options);
  LinearSolver(const LinearSolver&) = delete;
  LinearSolver& operator=(const LinearSolver&) = delete;

  /// The preconditioner is made anew with the next matrix.
  void renew() { rebuild_ = true; }
  /// A = dF/dq at q, until q changes; `equation` lives as long. Collective.
  void linearize(Vec q, const StageEquation& equation);
  /// Multiplies with A, in the axes of the preconditioner.
  Mat product() const { return product_; }
  struct Outcome {
    int iterations = 0;
    bool usable = true;  ///< false: a matrix or a vector has what is not a number
  };
  /// x = A⁻¹ b, whose residual is to be `fall` |b|: expected to be, where Newton's method judges (eisenstat_walker). More is
  /// left after the most iterations that are allowed. Collective.
  Outcome solve(Vec b, Vec x, double fall);

 private:
  Mat for_preconditioner() const;
  void set_up_double();
  void set_up_single();
  void use_options(KSP ksp, std::optional<LastCorrection>& last);
  void precondition(PC pc, const float* b, float* x);
  Outcome solve_double(Vec b, Vec x);
  Outcome solve_single(Vec b, Vec x);
  static PetscErrorCode multiply(Mat, Vec x, Vec y);
  static PetscErrorCode residual(void* self, Vec x, Vec f);

  EulerOperator& euler_;
  NewtonOptions options_;
  CallbackGuard guard_;
  MatHandle product_;       ///< in the axes of the preconditioner
  MatHandle difference_;    ///< product by differences, inertial axes
  VecHandle work_, right_;  ///< of difference_; b in those axes
  std::optional<BlockJacobian> jacobian_;
  std::optional<InterfaceCoupling> coupling_;  ///< what jacobian_ lacks
  MatHandle converted_;  ///< jacobian_ in the preconditioner's own storage, when that is not BAIJ
  Frames made_in_;       ///< where the zones were when the preconditioner was made
  ZoneTurn turned_;      ///< since then; linear systems are solved in the axes from before
  KspHandle ksp_;
  std::optional<SingleGmres> single_;  ///< where everything can be of floats
  std::optional<LastCorrection> last_correction_, last_correction_single_;  ///< where Newton's method may judge a solve
  bool near_first_ = false;        ///< so the preconditioner was last applied
  std::vector<float> near_, rest_;  ///< correction near interfaces, what it leaves of a right side
  const StageEquation* equation_ = nullptr;
  double fall_ = 0;
  bool rebuild_ = true;
};

}  // namespace windhover::fluid
