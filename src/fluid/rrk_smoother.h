// Rational Runge–Kutta as a linear solver of PETSc's.
#pragma once

namespace windhover::fluid {

/// Registers the KSP type "rrk": a fixed number of two-stage rational Runge–Kutta steps (rational_runge_kutta.h) in
/// pseudo-time towards A z = b, W(z) = M⁻¹ (b − A z) with the KSP's own preconditioner M, whose blocks are local pseudo-steps.
/// It is nonlinear in b: what it preconditions must be a flexible method. Options: -…ksp_max_it.
void register_rrk();

}  // namespace windhover::fluid
