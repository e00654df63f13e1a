#include "mesh/remote_rows.h"

namespace windhover::mesh {

RemoteRows::RemoteRows(MPI_Comm comm, PetscSF forest) : comm_(comm) {
  petsc(PetscSFSetUp(forest));
  PetscInt n = 0;
  const PetscMPIInt* ranks = nullptr;
  const PetscInt *start = nullptr, *rows = nullptr;
  petsc(PetscSFGetRootRanks(forest, &n, &ranks, &start, &rows, nullptr));
  bool scattered = false;
  for (PetscInt i = 0; i < n; ++i) {
    from_.push_back({ranks[i], rows[start[i]], start[i + 1] - start[i]});
    for (PetscInt k = start[i] + 1; k < start[i + 1]; ++k) scattered = scattered || rows[k] != rows[k - 1] + 1;
  }
  if (scattered) {
    scattered_.assign(rows, rows + start[n]);
    for (PetscInt i = 0; i < n; ++i) from_[i].first = start[i];
  }
  petsc(PetscSFGetLeafRanks(forest, &n, &ranks, &start, &rows));
  for (PetscInt i = 0; i < n; ++i) to_.push_back({ranks[i], start[i], start[i + 1] - start[i]});
  if (n > 0) sent_.assign(rows, rows + start[n]);
}

}  // namespace windhover::mesh
