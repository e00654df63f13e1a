#include "fluid/interface_coupling.h"

#include "fluid/five_columns.h"

namespace windhover::fluid {

InterfaceCoupling::InterfaceCoupling(EulerOperator& euler)
    : euler_(euler),
      cells_(euler.sliding_faces().own_cells()),
      x_(std::make_unique_for_overwrite<float[]>(size_t(kVariables) * euler.sliding_faces().n_cells())) {}

void InterfaceCoupling::renew(Vec q, const Frames& frames, double scale, const ZoneTurn& turn) {
  euler_.interface_jacobian(q, frames, scale, turn, blocks_);
}

std::vector<mesh::Index> InterfaceCoupling::cells_within(int layers) const {
  const mesh::Mesh& mesh = euler_.mesh();
  std::vector<char> within(mesh.n_cells, false);
  for (const mesh::Index c : cells_) within[c] = true;
  for (int k = 0; k < layers; ++k) {
    const std::vector<char> nearer = within;
    for (const mesh::FaceBlock& b : mesh.faces)
      for (int i = 0; i < b.count; ++i)
        if (nearer[b.cell[0][i]] || nearer[b.cell[1][i]]) within[b.cell[0][i]] = within[b.cell[1][i]] = true;
  }
  std::vector<mesh::Index> cells;
  for (mesh::Index c = 0; c < mesh.n_owned; ++c)
    if (within[c]) cells.push_back(c);
  return cells;
}

void InterfaceCoupling::subtract_product(double* sum) {
  euler_.sliding_faces().begin_exchange(x_.get(), five_);
  euler_.sliding_faces().end_exchange(x_.get(), five_);
  for (const InterfaceBlock& b : blocks_) {
    const Column product = times(b.block, x_.get() + size_t(kVariables) * b.column);
    for (int k = 0; k < kVariables; ++k) sum[size_t(kVariables) * b.row + k] -= product[k];
  }
}

}  // namespace windhover::fluid
