// The two-stage rational Runge–Kutta method (Wambecq, Computing 20, 1978, 333): explicit, and stable as if it were implicit.
#pragma once
#include "base/petsc.h"

namespace windhover::fluid {

/// One pseudo-step of dz/dτ = W(z), given g1 = Δτ W(z) and g2 = Δτ W(z + g1/2), all of one layout; Δτ may differ from
/// unknown to unknown:
///   z += [2 g1 ⟨g1,g3⟩ − g3 ⟨g1,g1⟩] / ⟨g3,g3⟩,   g3 = 2 g1 − g2,   inner products over all unknowns of all ranks.
/// On dz/dτ = −λz, λ real or complex, the factor is (1 − λΔτ/2) / (1 + λΔτ/2). Nonlinear in W even where W is linear.
/// Nothing changes where g1 = 0; z is not finite where only g3 = 0. Collective, one reduction.
void rational_update(Vec g1, Vec g2, Vec z);

}  // namespace windhover::fluid
