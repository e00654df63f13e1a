// Solvers of small problems, and of each rank's own part, as PETSc preconditioners.
#pragma once
#include "base/petsc.h"

namespace windhover::fluid {

class InterfaceCoupling;

/// Incomplete factors M of this rank's own part of a BAIJ matrix, in bfloat16 (BlockIlu). With a coupling C (or null) they are
/// applied as M⁻¹ (1 − C D⁻¹), D their pivots: the first terms of the inverse's series in C, with A⁻¹ ≈ D⁻¹ inside.
void set_up_block_ilu(PC pc, int levels, InterfaceCoupling* coupling);

/// UMFPACK, the whole problem on every rank. AIJ matrices.
void set_up_everywhere_lu(PC pc);

}  // namespace windhover::fluid
