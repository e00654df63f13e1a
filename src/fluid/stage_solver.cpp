#include "fluid/stage_solver.h"

#include <cmath>

namespace windhover::fluid {

/// 2-norms over all cells of the volume, and of the surface area times the far field's pressure: the sizes of what
/// cancels in a residual.
RoundOff::RoundOff(const EulerOperator& euler) {
  const mesh::Mesh& mesh = euler.mesh();
  std::vector<double> surface(mesh.n_gradient, 0.0);
  const auto add = [&](const std::vector<mesh::FaceBlock>& blocks, int sides) {
    for (const auto& b : blocks)
      for (int i = 0; i < b.count; ++i)
        for (int s = 0; s < sides; ++s) surface[b.cell[s][i]] += std::hypot(b.area[0][i], b.area[1][i], b.area[2][i]);
  };
  add(mesh.faces, 2);
  for (const auto& patch : mesh.patches) add(patch.blocks, 1);
  double sums[2] = {};
  for (mesh::Index c = 0; c < mesh.n_owned; ++c) {
    sums[0] += mesh.volume[c] * mesh.volume[c];
    sums[1] += surface[c] * surface[c];
  }
  MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, mesh.comm);
  volume_norm_ = std::sqrt(sums[0]);
  surface_norm_ = euler.model().far.p * std::sqrt(sums[1]);
}

double RoundOff::operator()(const Combination& c) const {
  constexpr double kRoundOff = 3e-15;
  return kRoundOff * (c.mass * volume_norm_ + c.rate * surface_norm_);
}

}  // namespace windhover::fluid
