// Solvers of small problems, and of each rank's own part, as PETSc preconditioners.
#pragma once
#include "base/petsc.h"

namespace windhover::fluid {

class InterfaceCoupling;

/// Incomplete factors M of this rank's own part of a BAIJ matrix and one layer of other ranks' rows (OverlappingRows), in
/// bytes (BlockIlu). With a coupling C (or null) they are applied as M⁻¹ (1 − C B⁻¹ (1 − C D⁻¹)), B⁻¹ and D⁻¹ cheap guesses
/// of M⁻¹ near interfaces (InterfaceBand).
void set_up_block_ilu(PC pc, int levels, InterfaceCoupling* coupling);
/// x = M⁻¹ b, five floats per owned cell. Collective.
void apply_block_ilu(PC pc, const float* b, float* x);
/// Layers of cells beside those at interfaces.
inline constexpr int kNearInterfaces = 6;
/// The rows of x in these layers, by B⁻¹ and D⁻¹ alone; with a coupling. Collective.
void apply_near_interfaces(PC pc, const float* b, float* x);

/// UMFPACK, the whole problem on every rank. AIJ matrices.
void set_up_everywhere_lu(PC pc);

}  // namespace windhover::fluid
