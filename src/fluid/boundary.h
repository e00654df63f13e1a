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

  // upstream: 1 where the flow leaves. Rounded off about zero, for the pressure depends on which entropy is taken and
  // Newton's method cannot cross a jump.
  const T x = maximum(minimum((face_un - lift(n.grid_speed)) / (0.1 * far_c), T(1.0)), T(-1.0));
  const T inside = 0.5 + x * (0.75 - 0.25 * x * x);
  const double far_entropy = far.p / std::pow(far.rho, gamma);
  const T entropy = far_entropy + inside * (s.p / power(s.rho, gamma) - far_entropy);
  const T rho = power(face_c * face_c / (gamma * entropy), 1.0 / (gamma - 1.0));
  const T tangential_u = lift(far.u - far_un * n.x), tangential_v = lift(far.v - far_un * n.y),
          tangential_w = lift(far.w - far_un * n.z);
  return {rho, face_un * n.x + tangential_u + inside * (s.u - un * n.x - tangential_u),
          face_un * n.y + tangential_v + inside * (s.v - un * n.y - tangential_v),
          face_un * n.z + tangential_w + inside * (s.w - un * n.z - tangential_w), rho * face_c * face_c / gamma};
}

}  // namespace windhover::fluid
