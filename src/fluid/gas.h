// A perfect gas and its states. Everything nondimensional: density by rho_inf, velocity by c_inf, pressure by rho_inf c_inf^2.
#pragma once
#include "base/dual.h"

namespace windhover::fluid {

inline constexpr int kVariables = 5;

/// Primitive state; velocity in inertial axes. T is double, Pack or Dual of them.
template <class T>
struct State {
  T rho, u, v, w, p;
};

/// Flux through a face, or a rate of change, of mass, momentum (inertial axes) and energy.
template <class T>
struct Flux {
  T mass, x, y, z, energy;
};

template <class T>
Flux<T> operator+(const Flux<T>& a, const Flux<T>& b) {
  return {a.mass + b.mass, a.x + b.x, a.y + b.y, a.z + b.z, a.energy + b.energy};
}
template <class T>
Flux<T> operator-(const Flux<T>& a, const Flux<T>& b) {
  return {a.mass - b.mass, a.x - b.x, a.y - b.y, a.z - b.z, a.energy - b.energy};
}
template <class T, class S>
Flux<T> operator*(const S& s, const Flux<T>& a) {
  return {s * a.mass, s * a.x, s * a.y, s * a.z, s * a.energy};
}

/// Those of eight that one register holds.
template <class T>
auto part(const State<T>& s, int i) {
  return State{part(s.rho, i), part(s.u, i), part(s.v, i), part(s.w, i), part(s.p, i)};
}

template <class T>
T speed_squared(const State<T>& s) {
  return s.u * s.u + s.v * s.v + s.w * s.w;
}

/// Total energy per volume.
template <class T>
T total_energy(const State<T>& s, double gamma) {
  return s.p * (1.0 / (gamma - 1.0)) + 0.5 * s.rho * speed_squared(s);
}

/// Conserved (rho, rho u, rho v, rho w, e) to primitive.
template <class T>
State<T> primitive(const T q[kVariables], double gamma) {
  const T inverse = reciprocal(q[0]);
  State<T> s{q[0], q[1] * inverse, q[2] * inverse, q[3] * inverse, q[4]};
  s.p = (gamma - 1.0) * (q[4] - 0.5 * q[0] * speed_squared(s));
  return s;
}

template <class T>
void conserved(const State<T>& s, double gamma, T q[kVariables]) {
  q[0] = s.rho;
  q[1] = s.rho * s.u;
  q[2] = s.rho * s.v;
  q[3] = s.rho * s.w;
  q[4] = total_energy(s, gamma);
}

/// One face as the fluxes see it: unit normal in inertial axes, and the grid's normal velocity v_g·n (mean over the face).
template <class G>
struct FaceNormal {
  G x, y, z;
  G grid_speed;
};

template <class T, class G>
T normal_speed(const State<T>& s, const FaceNormal<G>& n) {
  return s.u * n.x + s.v * n.y + s.w * n.z;
}

/// F(q)·n − q (v_g·n): what leaves through one square metre of a moving face.
template <class T, class G>
Flux<T> physical_flux(const State<T>& s, const FaceNormal<G>& n, double gamma) {
  const T un = normal_speed(s, n);
  const T relative = un - n.grid_speed;
  const T mass = s.rho * relative;
  return {mass, mass * s.u + s.p * n.x, mass * s.v + s.p * n.y, mass * s.w + s.p * n.z,
          total_energy(s, gamma) * relative + s.p * un};
}

}  // namespace windhover::fluid
