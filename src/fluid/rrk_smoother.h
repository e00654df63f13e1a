// Rational Runge–Kutta as a linear solver of PETSc's.
#pragma once
#include "base/petsc.h"

namespace windhover::fluid {

/// Registers the KSP type "rrk": a fixed number of two-stage rational Runge–Kutta steps (rational_runge_kutta.h) in
/// pseudo-time towards A z = b, W(z) = M⁻¹ (b − A z) with the KSP's own preconditioner M, whose blocks are local pseudo-steps.
/// It is nonlinear in b: what it preconditions must be a flexible method. Options: -…ksp_max_it, -…ksp_rrk_step.
void register_rrk();

/// Length of the pseudo-time steps, 1 unless set. An error z that M⁻¹A multiplies by m falls by (1 − m step/2) / (1 + m step/2):
/// with an M as good as incomplete factors most m are near 1, and a step of 2 is best; with diagonal blocks they are
/// not, and a step of 1 is better.
void set_rrk_step(KSP ksp, double step);

}  // namespace windhover::fluid
