// The flat table of fluxes: each entry holds its kernels for all reconstructions. One file instantiates one entry.
#pragma once
#include "fluid/face_kernel.h"

namespace windhover::fluid {

/// A 5x5 block for each of eight faces, column-major: entry [column * 5 + row].
using BlockPack = std::array<Pack, kVariables * kVariables>;

struct FluxKernels {
  using Sum = void (*)(const FaceInput&, const mesh::FaceBlock* blocks, int count, Row* rates);
  const char* name;
  bool needs_mach;    ///< uses the relative Mach number even without the low-Mach option
  Sum residual[3];    ///< by Reconstruction
  Sum derivative[3];  ///< along FaceInput::d_cells
  /// d(first-order flux)/d(conserved state) of either side, times the area.
  void (*jacobian)(const FaceInput&, const mesh::FaceBlock&, BlockPack sides[2]);
};

extern const FluxKernels kRoeKernels, kHllcKernels, kSlau2Kernels;
inline const FluxKernels* const kFluxes[] = {&kRoeKernels, &kHllcKernels, &kSlau2Kernels};

/// The primitive state of cell rows with the derivative along conserved variable `k`.
inline State<Dual<Pack>> seeded_state(const State<Pack>& s, int k, double gamma) {
  Pack values[kVariables];
  conserved(s, gamma, values);
  Dual<Pack> q[kVariables];
  for (int i = 0; i < kVariables; ++i) q[i] = {values[i], Pack(i == k ? 1.0 : 0.0)};
  return primitive(q, gamma);
}

inline State<Dual<Pack>> constant_state(const State<Pack>& s) {
  const Pack zero(0.0);
  return {{s.rho, zero}, {s.u, zero}, {s.v, zero}, {s.w, zero}, {s.p, zero}};
}

inline void store_column(const Flux<Dual<Pack>>& f, const Pack& area, int k, BlockPack& block) {
  Pack* column = &block[k * kVariables];
  column[0] = area * f.mass.d, column[1] = area * f.x.d, column[2] = area * f.y.d, column[3] = area * f.z.d;
  column[4] = area * f.energy.d;
}

template <class FluxScheme>
[[gnu::flatten]] void flux_jacobian(const FaceInput& in, const mesh::FaceBlock& b, BlockPack sides[2]) {
  const FaceGeometry face = face_geometry(in, b);
  const auto l = face_side<Reconstruction::first_order, Pack>(in, b, 0);
  const auto r = face_side<Reconstruction::first_order, Pack>(in, b, 1);
  const Dual<Pack> mach = {face_mach(l.mach_squared, r.mach_squared), Pack(0.0)};  // frozen
  const auto fixed_l = constant_state(l.state), fixed_r = constant_state(r.state);
  for (int k = 0; k < kVariables; ++k) {
    store_column(flux_of<FluxScheme>(seeded_state(l.state, k, in.gamma), fixed_r, face.normal, mach, in.gamma),
                 face.area, k, sides[0]);
    store_column(flux_of<FluxScheme>(fixed_l, seeded_state(r.state, k, in.gamma), face.normal, mach, in.gamma),
                 face.area, k, sides[1]);
  }
  const Pack damping = 0.5 * in.damping * face.area;
  for (int k = 0; k < kVariables; ++k) {
    Pack &own = sides[0][(kVariables + 1) * k], &other = sides[1][(kVariables + 1) * k];
    own += damping, other = other - damping;
  }
}

template <class FluxScheme>
constexpr FluxKernels make_flux_kernels(const char* name, bool needs_mach) {
  using enum Reconstruction;
  using D = Dual<Pack>;
  return {name,
          needs_mach,
          {sum_interior<FluxScheme, first_order, Pack>, sum_interior<FluxScheme, linear, Pack>,
           sum_interior<FluxScheme, limited, Pack>},
          {sum_interior<FluxScheme, first_order, D>, sum_interior<FluxScheme, linear, D>,
           sum_interior<FluxScheme, limited, D>},
          flux_jacobian<FluxScheme>};
}

}  // namespace windhover::fluid
