#include "fluid/line_search.h"

#include <algorithm>
#include <cmath>

namespace windhover::fluid {
namespace {

constexpr double kDecrease = 1e-4;  ///< of |F|, as part of what the step promises
constexpr double kLeastPart = 1e-6;

/// Part of the step to try after `part` of it made |F| `growth` times as large.
double shorter(double part, double growth) {
  const double least = part * part / (growth * growth - 1 + 2 * part);
  return std::isfinite(least) ? std::clamp(least, 0.1 * part, 0.5 * part) : 0.1 * part;
}

PetscErrorCode search(SNESLineSearch search, void*) {
  return CallbackGuard().run([search] {
    SNES snes = nullptr;
    Vec x = nullptr, f = nullptr, step = nullptr, start = nullptr;
    double x_norm = 0, norm = 0, step_norm = 0, new_norm = 0;
    petsc(SNESLineSearchGetSNES(search, &snes));
    petsc(SNESLineSearchGetVecs(search, &x, &f, &step, &start, nullptr));
    petsc(SNESLineSearchGetNorms(search, &x_norm, &norm, &step_norm));
    PetscBool changed = PETSC_FALSE;
    petsc(SNESLineSearchPreCheck(search, x, step, &changed));
    petsc(VecCopy(x, start));
    double part = 1;
    while (true) {
      petsc(VecWAXPY(x, -part, step, start));
      petsc(SNESComputeFunction(snes, x, f));  // of x itself: who asks for more at x finds it at hand
      petsc(VecNorm(f, NORM_2, &new_norm));
      if (new_norm <= (1 - kDecrease * part) * norm) break;
      part = shorter(part, new_norm / norm);
      if (part < kLeastPart) {
        petsc(VecCopy(start, x));
        petsc(SNESLineSearchSetReason(search, SNES_LINESEARCH_FAILED_REDUCT));
        return;
      }
    }
    petsc(SNESLineSearchSetLambda(search, part));
    petsc(SNESLineSearchSetNorms(search, x_norm, new_norm, step_norm));
  });
}

}  // namespace

void use_parabolic_backtracking(SNES snes) {
  SNESLineSearch line_search = nullptr;
  petsc(SNESGetLineSearch(snes, &line_search));
  petsc(SNESLineSearchSetType(line_search, SNESLINESEARCHSHELL));
  petsc(SNESLineSearchShellSetUserFunc(line_search, search, nullptr));
}

}  // namespace windhover::fluid
