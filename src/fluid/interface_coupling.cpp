#include "fluid/interface_coupling.h"

#include "fluid/five_columns.h"

namespace windhover::fluid {

InterfaceCoupling::InterfaceCoupling(EulerOperator& euler)
    : euler_(euler),
      cells_(euler.sliding_faces().own_cells()),
      place_(euler.sliding_faces().place()),
      x_(kVariables * (cells_.size() + euler.sliding_faces().n_cells() - euler.mesh().n_cells)) {}

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
  const auto n = static_cast<mesh::Index>(cells_.size());
  others_.follow(euler_.others_at_interfaces(frames), place_, n - euler_.mesh().n_cells);
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
