#include "fluid/boundary_kernels.h"

namespace windhover::fluid {
namespace {

using enum Reconstruction;
using D = Dual<Pack>;
using S = Dual<PackOf<float>>;

void boundary_jacobian(const FaceInput& in, BoundaryKind kind, const mesh::FaceBlock& b, BlockPack& block) {
  const auto face = face_geometry<Pack>(in, b);
  const State<Pack> inside = face_side<first_order, Pack>(in, b, 0).state;
  for (int k = 0; k < kVariables; ++k) {
    const State<D> s = boundary_state(kind, seeded_state(inside, k, in.gamma), in, face.normal);
    store_column(physical_flux(s, face.normal, in.gamma), face.area, k, block);
  }
}

template <Reconstruction R>
State<Pack> state_on_face(const FaceInput& in, BoundaryKind kind, const mesh::FaceBlock& b) {
  return boundary_state(kind, face_side<R, Pack>(in, b, 0).state, in, face_geometry<Pack>(in, b).normal);
}

}  // namespace

const BoundaryKernels kBoundaryKernels = {
    {sum_boundary<first_order, Pack>, sum_boundary<linear, Pack>, sum_boundary<limited, Pack>},
    {sum_boundary<first_order, D>, sum_boundary<linear, D>, sum_boundary<limited, D>},
    {sum_boundary<first_order, S>, sum_boundary<linear, S>, sum_boundary<limited, S>},
    boundary_jacobian,
    {state_on_face<first_order>, state_on_face<linear>, state_on_face<limited>}};

}  // namespace windhover::fluid
