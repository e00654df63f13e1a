#include "fluid/zone_turn.h"

namespace windhover::fluid {

ZoneTurn::ZoneTurn(const Frames& from, const Frames& to) {
  for (size_t z = 0; z < from.size(); ++z) {
    turn_.push_back(to[z].R * from[z].R.transpose());
    back_.push_back(turn_.back().transpose());
    none_ = none_ && to[z].R == from[z].R;
  }
}

void ZoneTurn::turn(const mesh::Mesh& mesh, const std::vector<mesh::Mat3>& turns, Vec q) {
  double* v = nullptr;
  petsc(VecGetArray(q, &v));
  for (mesh::Index c = 0; c < mesh.n_owned; ++c) {
    Eigen::Map<mesh::Vec3> momentum(v + 5 * c + 1);
    momentum = mesh::Vec3(turns[mesh.cell_zone[c]] * momentum);
  }
  petsc(VecRestoreArray(q, &v));
}

}  // namespace windhover::fluid
