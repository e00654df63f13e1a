#include "fluid/rational_runge_kutta.h"

namespace windhover::fluid {

void rational_update(Vec g1, Vec g2, Vec z) {
  const double *a = nullptr, *b = nullptr;
  PetscInt n = 0;
  petsc(VecGetLocalSize(g1, &n));
  petsc(VecGetArrayRead(g1, &a));
  petsc(VecGetArrayRead(g2, &b));
  double s11 = 0, s13 = 0, s33 = 0;
  for (PetscInt i = 0; i < n; ++i) {
    const double g3 = 2 * a[i] - b[i];
    s11 += a[i] * a[i];
    s13 += a[i] * g3;
    s33 += g3 * g3;
  }
  petsc(VecRestoreArrayRead(g1, &a));
  petsc(VecRestoreArrayRead(g2, &b));
  double sums[3] = {s11, s13, s33};
  MPI_Allreduce(MPI_IN_PLACE, sums, 3, MPI_DOUBLE, MPI_SUM, PetscObjectComm(reinterpret_cast<PetscObject>(z)));
  if (sums[0] == 0) return;
  petsc(VecAXPBYPCZ(z, 2 * (sums[1] - sums[0]) / sums[2], sums[0] / sums[2], 1, g1, g2));
}

}  // namespace windhover::fluid
