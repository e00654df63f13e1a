// What may be chosen of Newton's method and its linear solves.
#pragma once
#include "fluid/preconditioner.h"

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

}  // namespace windhover::fluid
