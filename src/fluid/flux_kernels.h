// The flat table of fluxes: each entry holds its kernels for all reconstructions. One file instantiates one entry.
#pragma once
#include "fluid/face_kernel.h"

namespace windhover::fluid {

/// A 5x5 block for each of eight faces, column-major: entry [column * 5 + row].
template <class Number>
using BlockPackOf = std::array<PackOf<Number>, kVariables * kVariables>;
using BlockPack = BlockPackOf<double>;

struct FluxKernels {
  template <class Number>
  using Sum = void (*)(const FaceInput&, const mesh::FaceBlockOf<Number>* blocks, int count, RowOf<Number>* rates);
  const char* name;
  bool needs_mach;                  ///< uses the relative Mach number even without the low-Mach option
  Sum<double> residual[3];          ///< by Reconstruction
  Sum<double> derivative[3];        ///< along the derivative rows
  Sum<float> derivative_single[3];  ///< the same of rows of floats
  /// d(first-order flux)/d(conserved state) of one side, times the area; from rows of doubles and of floats.
  void (*jacobian)(const FaceInput&, const mesh::FaceBlock&, int side, BlockPack& block);
  void (*jacobian_single)(const FaceInput&, const mesh::SingleFaceBlock&, int side, BlockPackOf<float>& block);
};

extern const FluxKernels kRoeKernels, kHllcKernels, kSlau2Kernels;
inline const FluxKernels* const kFluxes[] = {&kRoeKernels, &kHllcKernels, &kSlau2Kernels};

/// The primitive state of cell rows with the derivative along conserved variable `k`.
template <class P>
State<Dual<P>> seeded_state(const State<P>& s, int k, double gamma) {
  P values[kVariables];
  conserved(s, gamma, values);
  Dual<P> q[kVariables];
  for (int i = 0; i < kVariables; ++i) q[i] = {values[i], P(i == k ? 1.0 : 0.0)};
  return primitive(q, gamma);
}

template <class P>
State<Dual<P>> constant_state(const State<P>& s) {
  const P zero(0.0);
  return {{s.rho, zero}, {s.u, zero}, {s.v, zero}, {s.w, zero}, {s.p, zero}};
}

template <class P>
void store_column(const Flux<Dual<P>>& f, const P& area, int k, std::array<P, kVariables * kVariables>& block) {
  P* column = &block[k * kVariables];
  column[0] = area * f.mass.d, column[1] = area * f.x.d, column[2] = area * f.y.d, column[3] = area * f.z.d;
  column[4] = area * f.energy.d;
}

template <class FluxScheme, class Number>
[[gnu::flatten]] void flux_jacobian(const FaceInput& in, const mesh::FaceBlockOf<Number>& b, int side,
                                    BlockPackOf<Number>& block) {
  using P = PackOf<Number>;
  const auto face = face_geometry<P>(in, b);
  const auto l = face_side<Reconstruction::first_order, P>(in, b, 0);
  const auto r = face_side<Reconstruction::first_order, P>(in, b, 1);
  const Dual<P> mach = {face_mach(l.mach_squared, r.mach_squared), P(0.0)};  // frozen
  State<Dual<P>> states[2] = {constant_state(l.state), constant_state(r.state)};
  const State<P>& seeded = side == 0 ? l.state : r.state;
  for (int k = 0; k < kVariables; ++k) {
    states[side] = seeded_state(seeded, k, in.gamma);
    store_column(flux_of<FluxScheme>(states[0], states[1], face.normal, mach, in.gamma), face.area, k, block);
  }
  const P damping = (side == 0 ? 0.5 : -0.5) * in.damping * face.area;
  for (int k = 0; k < kVariables; ++k) block[(kVariables + 1) * k] += damping;
}

template <class FluxScheme>
constexpr FluxKernels make_flux_kernels(const char* name, bool needs_mach) {
  using enum Reconstruction;
  using D = Dual<Pack>;
  using S = Dual<PackOf<float>>;
  return {name,
          needs_mach,
          {sum_interior<FluxScheme, first_order, Pack>, sum_interior<FluxScheme, linear, Pack>,
           sum_interior<FluxScheme, limited, Pack>},
          {sum_interior<FluxScheme, first_order, D>, sum_interior<FluxScheme, linear, D>,
           sum_interior<FluxScheme, limited, D>},
          {sum_interior<FluxScheme, first_order, S>, sum_interior<FluxScheme, linear, S>,
           sum_interior<FluxScheme, limited, S>},
          flux_jacobian<FluxScheme, double>,
          flux_jacobian<FluxScheme, float>};
}

}  // namespace windhover::fluid
