#include "fluid/zone_turn.h"

namespace windhover::fluid {

ZoneTurn::ZoneTurn(const Frames& from, const Frames& to) {
  for (size_t z = 0; z < from.size(); ++z) {
    turn_.push_back(to[z].R * from[z].R.transpose());
    back_.push_back(turn_.back().transpose());
    none_ = none_ && to[z].R == from[z].R;
  }
}

void ZoneTurn::turn(const mesh::Mesh& mesh, const std::vector<mesh::Mat3>& turns, Vec from, Vec to) {
  const auto turned = [&](const double* a, double* b) {
    for (mesh::Index c = 0; c < mesh.n_owned; ++c, a += 5, b += 5) {
      const mesh::Vec3 momentum = turns[mesh.cell_zone[c]] * mesh::Vec3(a[1], a[2], a[3]);
      b[0] = a[0], b[1] = momentum.x(), b[2] = momentum.y(), b[3] = momentum.z(), b[4] = a[4];
    }
  };
  double* out = nullptr;
  const double* in = nullptr;
  petsc(VecGetArray(to, &out));
  if (from == to) {
    turned(out, out);
  } else {
    petsc(VecGetArrayRead(from, &in));
    turned(in, out);
    petsc(VecRestoreArrayRead(from, &in));
  }
  petsc(VecRestoreArray(to, &out));
}

}  // namespace windhover::fluid
