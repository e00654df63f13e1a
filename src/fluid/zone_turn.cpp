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
  turn(mesh, turns, v);
  petsc(VecRestoreArray(q, &v));
}

template <class Number>
void ZoneTurn::turn(const mesh::Mesh& mesh, const std::vector<mesh::Mat3>& turns, Number* q) {
  for (mesh::Index c = 0; c < mesh.n_owned; ++c) {
    Eigen::Map<Eigen::Vector3<Number>> momentum(q + 5 * c + 1);
    const mesh::Vec3 turned = turns[mesh.cell_zone[c]] * momentum.template cast<double>();
    momentum = turned.cast<Number>();
  }
}

template void ZoneTurn::turn(const mesh::Mesh&, const std::vector<mesh::Mat3>&, float*);

}  // namespace windhover::fluid
