// Vectors of floats for PETSc's Krylov methods, which know one precision only.
#pragma once
#include "base/petsc.h"

namespace windhover::fluid {

/// n floats on this rank, all zero, two in each of PETSc's entries: VecGetArray() gives their address. Has what GMRES asks of a
/// vector and its duplicates (copies, linear combinations, dot products, 2-norms; sums of products in doubles); what else
/// PETSc may ask of a vector is missing. Collective.
VecHandle make_single_vector(MPI_Comm comm, PetscInt n);

/// The address of a vector's floats, of which PETSc forgets what it knows; and to be read only.
float* single_values(Vec v);
const float* single_values_read(Vec v);

}  // namespace windhover::fluid
