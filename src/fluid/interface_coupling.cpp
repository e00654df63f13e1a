#include "fluid/interface_coupling.h"

namespace windhover::fluid {

InterfaceCoupling::InterfaceCoupling(EulerOperator& euler)
    : euler_(euler),
      cells_(euler.sliding_faces().own_cells()),
      x_(std::make_unique_for_overwrite<double[]>(size_t(kVariables) * euler.sliding_faces().n_cells())) {}

void InterfaceCoupling::renew(Vec q, const Frames& frames, double scale, const ZoneTurn& turn) {
  euler_.interface_jacobian(q, frames, scale, turn, blocks_);
}

void InterfaceCoupling::subtract_product(double* sum) {
  euler_.sliding_faces().exchange(x_.get(), kVariables);
  typedef Eigen::Matrix<double, kVariables, 1> Five;
  for (const InterfaceBlock& b : blocks_)
    Five::Map(sum + size_t(kVariables) * b.row) -= b.block.cast<double>() * Five::Map(x_.get() + size_t(kVariables) * b.column);
}

}  // namespace windhover::fluid
