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

void RemoteRows::choose(MPI_Comm comm, std::vector<Peer> to, std::vector<Index> sent, std::vector<Peer> from) {
  comm_ = comm;
  to_ = std::move(to);
  from_ = std::move(from);
  sent_ = std::move(sent);
  scattered_.clear();
}

void RemoteRows::follow(const RemoteRows& other, const std::vector<Index>& place, Index further) {
  choose(other.comm_, other.to_, other.sent_, other.from_);
  for (Index& row : sent_) row = place[row];
  for (Peer& p : from_) p.first += further;
}

}  // namespace windhover::mesh
