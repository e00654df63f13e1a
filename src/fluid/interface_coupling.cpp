#include "fluid/interface_coupling.h"

#include <numeric>

#include "base/collective.h"
#include "fluid/five_columns.h"

namespace windhover::fluid {

InterfaceCoupling::InterfaceCoupling(EulerOperator& euler)
    : euler_(euler), cells_(euler.sliding_faces().own_cells()), place_(euler.mesh().n_owned, -1) {
  for (size_t i = 0; i < cells_.size(); ++i) place_[cells_[i]] = static_cast<mesh::Index>(i);
  set_up_exchange();
}

void InterfaceCoupling::set_up_exchange() {
  const SlidingFaces& faces = euler_.sliding_faces();
  const mesh::Mesh& mesh = euler_.mesh();
  // who has each cell, and where among its own
  std::vector<PetscSFNode> known(faces.n_cells(), {rank_of(mesh.comm), -1});
  for (mesh::Index c = 0; c < mesh.n_owned; ++c) known[c].index = place_[c];
  faces.begin_exchange(known.data());
  faces.end_exchange(known.data());
  std::vector<PetscSFNode> remote(known.begin() + mesh.n_cells, known.end());
  std::vector<PetscInt> leaves(remote.size());
  std::iota(leaves.begin(), leaves.end(), static_cast<PetscInt>(cells_.size()));
  SfHandle forest;
  petsc(PetscSFCreate(mesh.comm, forest.out()));
  petsc(PetscSFSetGraph(forest, static_cast<PetscInt>(cells_.size()), static_cast<PetscInt>(leaves.size()), leaves.data(),
                        PETSC_COPY_VALUES, remote.data(), PETSC_COPY_VALUES));
  others_ = mesh::RemoteRows(mesh.comm, forest);
  x_.resize(kVariables * (cells_.size() + leaves.size()));
}

mesh::Index InterfaceCoupling::place(mesh::Index row) const {
  const mesh::Mesh& mesh = euler_.mesh();
  return row < mesh.n_owned ? place_[row] : static_cast<mesh::Index>(cells_.size()) + row - mesh.n_cells;
}

void InterfaceCoupling::renew(Vec q, const Frames& frames, double scale, const ZoneTurn& turn) {
  euler_.interface_jacobian(q, frames, scale, turn, blocks_);
  for (InterfaceBlock& b : blocks_) {
    b.row = place(b.row);
    b.column = place(b.column);
  }
}

std::vector<mesh::Index> InterfaceCoupling::cells_within(int layers) const {
  return own_cells_within(euler_.mesh(), cells_, layers);
}

void InterfaceCoupling::subtract_product(float* sum) {
  const auto rows = reinterpret_cast<std::array<float, kVariables>*>(x_.data());
  others_.begin(rows);
  others_.end(rows);
  for (const InterfaceBlock& b : blocks_) {
    const Column product = times(b.block, x_.data() + size_t(kVariables) * b.column);
    for (int k = 0; k < kVariables; ++k) sum[size_t(kVariables) * b.row + k] -= product[k];
  }
}

}  // namespace windhover::fluid
