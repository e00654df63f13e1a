// Preconditioners by name: how a KSP is set up around the assembled first-order Jacobian.
#pragma once
#include <string>

#include "base/petsc.h"

namespace windhover::fluid {

class InterfaceCoupling;

struct Preconditioner {
  const char* name;
  bool assembled;                         ///< needs the first-order Jacobian
  bool point_matrix;                      ///< wants it entry by entry (AIJ), not in blocks
  bool coupled;                           ///< knows what sliding interfaces add
  /// Called once; solvers' options still override. No coupling where there are no interfaces.
  void (*set_up)(PC pc, int ilu_levels, InterfaceCoupling* coupling);
  /// Applies it to five floats per owned cell; its set-up fails on all ranks or none. Null: it takes PETSc's vectors only.
  void (*apply_single)(PC pc, const float* b, float* x) = nullptr;
  /// Of the same, a cheap one for the rows of x in kNearInterfaces layers of cells beside interfaces; others stay as they are.
  void (*apply_near_interfaces)(PC pc, const float* b, float* x) = nullptr;
};

/// ilu (each rank's part, overlap one), asm (PETSc's, overlap one), rrk (a few rational Runge–Kutta steps), rrk-multigrid
/// (aggregation multigrid smoothed by them, multigrid.h), point_block_jacobi, lu (UMFPACK, whole problem on every rank), none.
extern const Preconditioner kPreconditioners[7];

/// UserError naming the valid ones when there is no such one.
const Preconditioner& preconditioner(const std::string& name);

}  // namespace windhover::fluid
