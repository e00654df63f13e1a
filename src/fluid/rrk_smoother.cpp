#include "fluid/rrk_smoother.h"

#include "base/petsc.h"
#include "fluid/rational_runge_kutta.h"
// needs PETSc's types before it
#include <petsc/private/kspimpl.h>

namespace windhover::fluid {
namespace {

enum Work { kResidual, kFirst, kSecond, kWorkVectors };

double& step_of(KSP ksp) { return *static_cast<double*>(ksp->data); }

PetscErrorCode set_from_options(KSP ksp, PetscOptionItems* PetscOptionsObject) {
  PetscOptionsHeadBegin(PetscOptionsObject, "rational Runge-Kutta");
  PetscCall(PetscOptionsReal("-ksp_rrk_step", "pseudo-time step", nullptr, step_of(ksp), &step_of(ksp), nullptr));
  PetscOptionsHeadEnd();
  return 0;
}

PetscErrorCode set_up(KSP ksp) { return KSPSetWorkVecs(ksp, kWorkVectors); }

PetscErrorCode solve(KSP ksp) {
  return CallbackGuard().run([ksp] {
    Mat matrix = nullptr;
    petsc(KSPGetOperators(ksp, &matrix, nullptr));
    const Vec b = ksp->vec_rhs, z = ksp->vec_sol, residual = ksp->work[kResidual], g1 = ksp->work[kFirst],
              g2 = ksp->work[kSecond];
    const double step = step_of(ksp);
    if (ksp->guess_zero) petsc(VecSet(z, 0.0));
    for (ksp->its = 0; ksp->its < ksp->max_it; ++ksp->its) {
      if (ksp->its == 0 && ksp->guess_zero) {
        petsc(VecCopy(b, residual));
      } else {
        petsc(MatMult(matrix, z, residual));
        petsc(VecAYPX(residual, -1.0, b));
      }
      petsc(PCApply(ksp->pc, residual, g1));
      petsc(MatMult(matrix, g1, residual));
      petsc(PCApply(ksp->pc, residual, g2));
      petsc(VecScale(g1, step));
      petsc(VecAYPX(g2, -0.5 * step * step, g1));  // step W(z + g1/2), g1 = step W(z)
      rational_update(g1, g2, z);
    }
    ksp->reason = KSP_CONVERGED_ITS;
  });
}

PetscErrorCode create(KSP ksp) {
  double* step = nullptr;
  const PetscErrorCode code = PetscNew(&step);  // KSPDestroyDefault frees it
  if (code) return code;
  *step = 1.0;
  ksp->data = step;
  ksp->ops->setfromoptions = set_from_options;
  ksp->ops->setup = set_up;
  ksp->ops->solve = solve;
  ksp->ops->destroy = KSPDestroyDefault;
  ksp->ops->buildsolution = KSPBuildSolutionDefault;
  ksp->ops->buildresidual = KSPBuildResidualDefault;
  return CallbackGuard().run([ksp] {
    petsc(KSPSetSupportedNorm(ksp, KSP_NORM_NONE, PC_LEFT, 2));
    petsc(KSPSetSupportedNorm(ksp, KSP_NORM_PRECONDITIONED, PC_LEFT, 1));
  });
}

}  // namespace

void set_rrk_step(KSP ksp, double step) { step_of(ksp) = step; }

void register_rrk() { petsc(KSPRegister("rrk", create)); }

}  // namespace windhover::fluid
