// What happens on eight faces: reconstruction from both sides, flux, and the sum into the cells.
// A face works on whole rows of cells, the flux on columns of eight faces.
#pragma once
#include <array>
#include <limits>
#include <tuple>

#include "fluid/boundary.h"
#include "fluid/cell_rows.h"
#include "fluid/gas.h"
#include "mesh/face_block.h"

namespace windhover::fluid {

enum class Reconstruction { first_order, linear, limited };

/// Everything a kernel reads besides the faces.
struct FaceInput {
  std::tuple<CellRows<double>, CellRows<float>> rows;
  double rotation[9];          ///< zone axes to inertial axes, row-major
  double velocity[3];          ///< of the zone's origin, in zone axes
  double angular_velocity[3];  ///< of the zone, in zone axes
  double gamma = 1.4;
  double limiter_threshold = 0;  ///< squared difference below which nothing is limited
  State<double> far{};
  double damping = 0;  ///< speed that assembled blocks add to that of each wave in the dissipation

  template <class Number>
  const CellRows<Number>& rows_of() const {
    return std::get<CellRows<Number>>(rows);
  }
};

template <class P>
struct FaceGeometry {
  FaceNormal<P> normal;
  P area;
};

template <class P>
FaceGeometry<P> face_geometry(const FaceInput& in, const FaceBlockFor<P>& b) {
  using Number = typename NumberOf<P>::type;
  P a[3], m[3];
  for (int k = 0; k < 3; ++k) a[k] = P::load(b.area[k]), m[k] = P::load(b.moment[k]);
  const P swept = in.velocity[0] * a[0] + in.velocity[1] * a[1] + in.velocity[2] * a[2] +
                  in.angular_velocity[0] * m[0] + in.angular_velocity[1] * m[1] + in.angular_velocity[2] * m[2];
  const P squared = a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
  const P inverse = inverse_sqrt(maximum(squared, P(std::numeric_limits<Number>::min())));  // padding has no area
  P n[3];
  for (int i = 0; i < 3; ++i)
    n[i] = inverse * (in.rotation[3 * i] * a[0] + in.rotation[3 * i + 1] * a[1] + in.rotation[3 * i + 2] * a[2]);
  return {{n[0], n[1], n[2], inverse * swept}, squared * inverse};
}

/// Van Leer's limiter between a cell's own slope and the difference across the face, made differentiable:
/// with g the slope times the distance and d the difference, t = 1 − (g−d)²/(g²+ε²) is van Leer's ratio
/// (2g−d) d/g² of upwind and central differences; t²(2−t) meets zero smoothly and keeps second order near t = 1.
/// Both sides of the face share one division.
template <class T>
std::array<T, 2> limited_fractions(const T& slope_l, const T& slope_r, const T& difference, double threshold) {
  const T size_l = slope_l * slope_l + threshold, size_r = slope_r * slope_r + threshold;
  const T inverse = reciprocal(size_l * size_r);
  const auto fraction = [&](const T& slope, const T& other_size) {
    const T gap = slope - difference;
    const T t = maximum(T(1.0) - gap * gap * (inverse * other_size), T(0.0));
    return t * t * (2.0 - t);
  };
  return {fraction(slope_l, size_r), fraction(slope_r, size_l)};
}

/// The change of a row along an arm; the Mach number is not reconstructed.
template <class Number>
PackOf<Number> change(const GradientRowOf<Number>& g, const Number* arm) {
  return first_lanes<kVariables>(g.along(arm));
}

/// States of one side of a block, as columns; T is PackOf<Number> or Dual of it.
template <class T>
struct Side {
  State<T> state;
  T mach_squared;
};

template <class T>
struct Rows;  // access to value rows, or to value and derivative rows

template <class Number>
struct Rows<PackOf<Number>> {
  using P = PackOf<Number>;
  static P cell(const FaceInput& in, int c) { return P::load(in.rows_of<Number>().cells[c].v); }
  static P slope(const FaceInput& in, int c, const Number* arm) {
    return change(in.rows_of<Number>().gradients[c], arm);
  }
  static void columns(const P rows[8], P out[8]) { transpose(rows, out); }
};

template <class Number>
struct Rows<Dual<PackOf<Number>>> {
  using P = PackOf<Number>;
  static Dual<P> cell(const FaceInput& in, int c) {
    const auto& rows = in.rows_of<Number>();
    return {P::load(rows.cells[c].v), P::load(rows.d_cells[c].v)};
  }
  static Dual<P> slope(const FaceInput& in, int c, const Number* arm) {
    const auto& rows = in.rows_of<Number>();
    return {change(rows.gradients[c], arm), change(rows.d_gradients[c], arm)};
  }
  static void columns(const Dual<P> rows[8], Dual<P> out[8]) {
    P part[8], turned[8];
    for (int i = 0; i < 8; ++i) part[i] = rows[i].v;
    transpose(part, turned);
    for (int i = 0; i < 8; ++i) out[i].v = turned[i], part[i] = rows[i].d;
    transpose(part, turned);
    for (int i = 0; i < 8; ++i) out[i].d = turned[i];
  }
};

/// Extrapolation leaves density and pressure at least a tenth of the cell's own.
template <class T>
T least_row(const T& own) {
  using P = PackFor<T>;
  using Number = typename NumberOf<T>::type;
  constexpr Number any = -0.1 * std::numeric_limits<Number>::max();
  alignas(64) static constexpr Number share[8] = {Number(0.1), 0, 0, 0, Number(0.1), 0, 0, 0};
  alignas(64) static constexpr Number offset[8] = {0, any, any, any, 0, any, any, any};
  return own * P::load(share) + P::load(offset);
}

/// The state of cell `side` of lane i, taken to the face without a limiter.
template <Reconstruction R, class T>
T face_row(const FaceInput& in, const FaceBlockFor<T>& b, int i, int side) {
  const T own = Rows<T>::cell(in, b.cell[side][i]);
  if constexpr (R == Reconstruction::first_order) return own;
  return maximum(own + Rows<T>::slope(in, b.cell[side][i], b.arm[i][side]), least_row(own));
}

/// The states of both cells of lane i, taken to the face and limited against each other.
template <class T>
std::array<T, 2> limited_face_rows(const FaceInput& in, const FaceBlockFor<T>& b, int i) {
  const int l = b.cell[0][i], r = b.cell[1][i];
  const auto *arm_l = b.arm[i][0], *arm_r = b.arm[i][1];
  const T own_l = Rows<T>::cell(in, l), own_r = Rows<T>::cell(in, r);
  const T change_l = Rows<T>::slope(in, l, arm_l), change_r = Rows<T>::slope(in, r, arm_r);
  // from the left centroid to the right one: along the own arm to the face, and back along the other's
  const auto fraction = limited_fractions(change_l - Rows<T>::slope(in, l, arm_r),
                                          Rows<T>::slope(in, r, arm_l) - change_r, own_r - own_l, in.limiter_threshold);
  return {maximum(own_l + fraction[0] * change_l, least_row(own_l)),
          maximum(own_r + fraction[1] * change_r, least_row(own_r))};
}

template <class T>
Side<T> side_of(const T rows[8]) {
  T columns[8];
  Rows<T>::columns(rows, columns);
  return {{columns[0], columns[1], columns[2], columns[3], columns[4]}, columns[kMach]};
}

/// One side without a limiter: boundaries, where there is nothing to limit against, and first order.
template <Reconstruction R, class T>
Side<T> face_side(const FaceInput& in, const FaceBlockFor<T>& b, int side) {
  T rows[8];
  for (int i = 0; i < 8; ++i) rows[i] = face_row<R, T>(in, b, i, side);
  return side_of(rows);
}

template <Reconstruction R, class T>
std::array<Side<T>, 2> face_sides(const FaceInput& in, const FaceBlockFor<T>& b) {
  if constexpr (R == Reconstruction::limited) {
    T l[8], r[8];
    for (int i = 0; i < 8; ++i) {
      const auto both = limited_face_rows<T>(in, b, i);
      l[i] = both[0], r[i] = both[1];
    }
    return {side_of(l), side_of(r)};
  } else {
    return {face_side<R, T>(in, b, 0), face_side<R, T>(in, b, 1)};
  }
}

/// Mach number of a face, 0..1: the root of the two sides' mean square (as in SLAU), smooth where their maximum is not.
template <class T>
T face_mach(const T& l, const T& r) {
  using std::sqrt;
  return sqrt(0.5 * (l + r) + 1e-8);
}

/// The part of a result that is summed: the value, or in linearised kernels the derivative.
template <class Number>
const PackOf<Number>& result(const PackOf<Number>& x) {
  return x;
}
template <class P>
const P& result(const Dual<P>& x) {
  return x.d;
}

template <class T, class P>
void flux_rows(const Flux<T>& f, const P& area, P rows[8]) {
  const P columns[8] = {area * result(f.mass),
                        area * result(f.x),
                        area * result(f.y),
                        area * result(f.z),
                        area * result(f.energy),
                        P(0.0),
                        P(0.0),
                        P(0.0)};
  transpose(columns, rows);
}

/// Asks for what the next blocks need while this one is worked on: the geometry of the third block from here, and the
/// next block's cells, which are scattered in memory. The processor's own prefetching finds neither in time.
template <Reconstruction R, class T>
void prefetch(const FaceInput& in, const FaceBlockFor<T>* blocks, int left, const RateRow<T>* rates) {
  constexpr bool dual = !std::is_same_v<T, PackFor<T>>;
  using Number = typename NumberOf<T>::type;
  const CellRows<Number>& rows = in.rows_of<Number>();
  if (left > 3)
    for (size_t k = 0; k < sizeof *blocks; k += 64) __builtin_prefetch(reinterpret_cast<const char*>(blocks + 3) + k);
  if (left < 2) return;
  const auto& b = blocks[1];
  for (int side = 0; side < 2; ++side)
    for (int i = 0; i < mesh::kLanes; ++i) {
      const int c = b.cell[side][i];
      __builtin_prefetch(&rows.cells[c]);
      __builtin_prefetch(&rates[c], 1);
      if constexpr (dual) __builtin_prefetch(&rows.d_cells[c]);
      if constexpr (R != Reconstruction::first_order)
        for (size_t k = 0; k < 16; k += 64 / sizeof(Number)) {
          __builtin_prefetch(rows.gradients[c].v + k);
          if constexpr (dual) __builtin_prefetch(rows.d_gradients[c].v + k);
        }
    }
}

/// A flux of eight faces, as many at a time as one register takes: eight at once would be more values than registers.
template <class FluxScheme, class T>
Flux<T> flux_of(const State<T>& l, const State<T>& r, const FaceNormal<PackFor<T>>& n, const T& mach, double gamma) {
  Flux<T> all;
  for (int i = 0; i < PackFor<T>::kParts; ++i) {
    const FaceNormal normal{part(n.x, i), part(n.y, i), part(n.z, i), part(n.grid_speed, i)};
    const auto f = FluxScheme::flux(part(l, i), part(r, i), normal, part(mach, i), gamma);
    set_part(all.mass, i, f.mass), set_part(all.x, i, f.x), set_part(all.y, i, f.y), set_part(all.z, i, f.z);
    set_part(all.energy, i, f.energy);
  }
  return all;
}

template <class Number>
void add(RowOf<Number>& row, const PackOf<Number>& x) {
  (PackOf<Number>::load(row.v) + x).store(row.v);
}

/// Interior faces: rates[cell] += what leaves. T = Dual<PackOf<Number>> gives the derivative along d_cells.
template <class FluxScheme, Reconstruction R, class T>
[[gnu::flatten]] void sum_interior(const FaceInput& in, const FaceBlockFor<T>* blocks, int count, RateRow<T>* rates) {
  for (int k = 0; k < count; ++k) {
    const auto& b = blocks[k];
    prefetch<R, T>(in, blocks + k, count - k, rates);
    const auto face = face_geometry<PackFor<T>>(in, b);
    const auto [l, r] = face_sides<R, T>(in, b);
    const T mach = face_mach(l.mach_squared, r.mach_squared);
    PackFor<T> rows[8];
    flux_rows(flux_of<FluxScheme>(l.state, r.state, face.normal, mach, in.gamma), face.area, rows);
    for (int i = 0; i < mesh::kLanes; ++i) {  // padding adds zeros
      add(rates[b.cell[0][i]], rows[i]);
      add(rates[b.cell[1][i]], -rows[i]);
    }
  }
}

template <class T>
State<T> boundary_state(BoundaryKind kind, const State<T>& s, const FaceInput& in, const FaceNormal<PackFor<T>>& n) {
  return kind == BoundaryKind::farfield ? farfield_state(s, in.far, n, in.gamma) : slip_state(s, n);
}

template <Reconstruction R, class T>
[[gnu::flatten]] void sum_boundary(const FaceInput& in, BoundaryKind kind, const FaceBlockFor<T>* blocks, int count,
                                   RateRow<T>* rates) {
  for (int k = 0; k < count; ++k) {
    const auto& b = blocks[k];
    const auto face = face_geometry<PackFor<T>>(in, b);
    const State<T> inside = face_side<R, T>(in, b, 0).state;
    PackFor<T> rows[8];
    flux_rows(physical_flux(boundary_state(kind, inside, in, face.normal), face.normal, in.gamma), face.area, rows);
    for (int i = 0; i < mesh::kLanes; ++i) add(rates[b.cell[0][i]], rows[i]);
  }
}

}  // namespace windhover::fluid
