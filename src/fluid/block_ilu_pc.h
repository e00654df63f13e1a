// Solvers of small problems, and of each rank's own part, as PETSc preconditioners.
#pragma once
#include "base/petsc.h"

namespace windhover::fluid {

/// Incomplete factors of this rank's own part of a BAIJ matrix, in bfloat16 (BlockIlu).
void set_up_block_ilu(PC pc, int levels);

/// UMFPACK, the whole problem on every rank. AIJ matrices.
void set_up_everywhere_lu(PC pc);

}  // namespace windhover::fluid
