// Boundary conditions: each gives the state on the boundary face; its physical flux is what passes.
#pragma once
#include <string>
#include <vector>

#include "base/dual.h"
#include "fluid/gas.h"

namespace windhover::fluid {

enum class BoundaryKind { wall, symmetry, farfield };

/// The flat table of names; also what error messages list.
struct BoundaryName {
  const char* name;
  BoundaryKind kind;
};
inline constexpr BoundaryName kBoundaryNames[] = {
    {"wall", BoundaryKind::wall}, {"symmetry", BoundaryKind::symmetry}, {"farfield", BoundaryKind::farfield}};

/// Slip: the normal velocity is the face's own. Flux: no mass, momentum p n, energy p v_g·n.
template <class T, class G>
State<T> slip_state(const State<T>& s, const FaceNormal<G>& n) {
  const T excess = normal_speed(s, n) - n.grid_speed;
  return {s.rho, s.u - excess * n.x, s.v - excess * n.y, s.w - excess * n.z, s.p};
}

/// Far field by Riemann invariants along the normal, relative to the moving face: the outgoing invariant comes from
/// inside, the incoming one from the free stream; entropy and tangential velocity come from upstream.
template <class T, class G>
State<T> farfield_state(const State<T>& s, const State<double>& far, const FaceNormal<G>& n, double gamma) {
  using std::sqrt;
  const double k = 2.0 / (gamma - 1.0);
  const T un = normal_speed(s, n);
  const T c = sqrt(gamma * s.p / s.rho);
  const G far_un = far.u * n.x + far.v * n.y + far.w * n.z;
  const auto lift = [](const G& g) { return T(0.0) + g; };
  const double far_c = std::sqrt(gamma * far.p / far.rho);

  // supersonic relative to the face: both invariants from one side
  const T outgoing = select(un + c < lift(n.grid_speed), lift(far_un + k * far_c), un + k * c);
  const T incoming = select(lift(n.grid_speed) < un - c, un - k * c, lift(far_un - k * far_c));
  const T face_un = 0.5 * (outgoing + incoming);
  const T face_c = (0.5 / k) * (outgoing - incoming);

  const auto leaves = lift(n.grid_speed) < face_un;
  const T entropy_source_rho = select(leaves, s.rho, T(far.rho));
  const T entropy_source_c2 = select(leaves, c * c, T(far_c * far_c));
  // rho^(gamma-1) / c^2 is constant along with entropy
  const T rho = entropy_source_rho * power(face_c * face_c / entropy_source_c2, 1.0 / (gamma - 1.0));
  const T shift_in = face_un - un, shift_far = face_un - far_un;
  return {rho, select(leaves, s.u + shift_in * n.x, far.u + shift_far * n.x),
          select(leaves, s.v + shift_in * n.y, far.v + shift_far * n.y),
          select(leaves, s.w + shift_in * n.z, far.w + shift_far * n.z), rho * face_c * face_c / gamma};
}

}  // namespace windhover::fluid
