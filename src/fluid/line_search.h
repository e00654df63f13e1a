// How much of a Newton step is taken.
#pragma once
#include "base/petsc.h"

namespace windhover::fluid {

/// The whole step unless the residual would grow; then, again and again, the least of the parabola through |F|² at both
/// ends with the slope of an exact Newton step (Dennis & Schnabel, Numerical Methods for Unconstrained Optimization,
/// 1983, section 6.3.2). PETSc's bt finds the slope by a product with the Jacobian, one more for each Newton iteration.
void use_parabolic_backtracking(SNES snes);

}  // namespace windhover::fluid
