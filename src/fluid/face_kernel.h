// What happens on eight faces: reconstruction from both sides, flux, and the sum into the cells.
// Cells are rows of eight doubles (rho, u, v, w, p, Mach, 0, 0), one cache line; a face works on whole rows,
// the flux on columns of eight faces.
#pragma once
#include <array>

#include "base/dual.h"
#include "fluid/boundary.h"
#include "fluid/gas.h"
#include "mesh/face_block.h"

namespace windhover::fluid {

struct alignas(64) Row {
  double v[8];
};
inline constexpr int kMach = 5;  ///< column of the cell's relative Mach number, at most 1

/// The three derivatives of a row, in zone axes.
using GradientRow = std::array<Row, 3>;

enum class Reconstruction { first_order, linear, limited };

/// Everything a kernel reads besides the faces. Derivative fields (d...) are used by linearised kernels only.
struct FaceInput {
  const Row* cells = nullptr;
  const GradientRow* gradients = nullptr;
  const Row* d_cells = nullptr;
  const GradientRow* d_gradients = nullptr;
  double rotation[9];         ///< zone axes to inertial axes, row-major
  double velocity[3];         ///< of the zone's origin, in zone axes
  double angular_velocity[3]; ///< of the zone, in zone axes
  double gamma = 1.4;
  double limiter_threshold = 0;  ///< squared difference below which nothing is limited
  State<double> far{};
};

struct FaceGeometry {
  FaceNormal<Pack> normal;
  Pack area;
};

inline FaceGeometry face_geometry(const FaceInput& in, const mesh::FaceBlock& b) {
  using std::sqrt;
  Pack a[3], m[3];
  for (int k = 0; k < 3; ++k) a[k] = Pack::load(b.area[k]), m[k] = Pack::load(b.moment[k]);
  const Pack swept = in.velocity[0] * a[0] + in.velocity[1] * a[1] + in.velocity[2] * a[2] +
                     in.angular_velocity[0] * m[0] + in.angular_velocity[1] * m[1] + in.angular_velocity[2] * m[2];
  const Pack area = sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
  const Pack inverse = 1.0 / maximum(area, Pack(1e-300));  // padding has no area
  Pack n[3];
  for (int i = 0; i < 3; ++i)
    n[i] = inverse * (in.rotation[3 * i] * a[0] + in.rotation[3 * i + 1] * a[1] + in.rotation[3 * i + 2] * a[2]);
  return {{n[0], n[1], n[2], inverse * swept}, area};
}

/// Van Leer's limiter between the cell's own slope and the difference across the face, made differentiable:
/// with g the slope times the distance and d the difference, t = 1 − (g−d)²/(g²+ε²) is van Leer's ratio
/// (2g−d) d/g² of upwind and central differences; t²(2−t) meets zero smoothly and keeps second order near t = 1.
template <class T>
T limited_fraction(const T& slope, const T& difference, double threshold) {
  const T gap = slope - difference;
  const T t = maximum(T(1.0) - gap * gap / (slope * slope + threshold), T(0.0));
  return t * t * (2.0 - t);
}

inline Pack dot(const GradientRow& g, const double* arm) {
  return Pack::load(g[0].v) * arm[0] + Pack::load(g[1].v) * arm[1] + Pack::load(g[2].v) * arm[2];
}

/// States of one side of a block, as columns; T is Pack or Dual<Pack>.
template <class T>
struct Side {
  State<T> state;
  T mach;
};

template <class T>
struct Rows;  // access to value rows, or to value and derivative rows

template <>
struct Rows<Pack> {
  static Pack cell(const FaceInput& in, int c) { return Pack::load(in.cells[c].v); }
  static Pack slope(const FaceInput& in, int c, const double* arm) { return dot(in.gradients[c], arm); }
  static void columns(const Pack rows[8], Pack out[8]) { transpose(rows, out); }
  static double value(const Pack& row, int k) { return row[k]; }
};

template <>
struct Rows<Dual<Pack>> {
  static Dual<Pack> cell(const FaceInput& in, int c) { return {Pack::load(in.cells[c].v), Pack::load(in.d_cells[c].v)}; }
  static Dual<Pack> slope(const FaceInput& in, int c, const double* arm) {
    return {dot(in.gradients[c], arm), dot(in.d_gradients[c], arm)};
  }
  static void columns(const Dual<Pack> rows[8], Dual<Pack> out[8]) {
    Pack part[8], turned[8];
    for (int i = 0; i < 8; ++i) part[i] = rows[i].v;
    transpose(part, turned);
    for (int i = 0; i < 8; ++i) out[i].v = turned[i], part[i] = rows[i].d;
    transpose(part, turned);
    for (int i = 0; i < 8; ++i) out[i].d = turned[i];
  }
  static double value(const Dual<Pack>& row, int k) { return row.v[k]; }
};

/// The state of cell `side` of lane i, taken to the face.
template <Reconstruction R, class T>
T face_row(const FaceInput& in, const mesh::FaceBlock& b, int i, int side, bool boundary) {
  const int c = b.cell[side][i];
  const T own = Rows<T>::cell(in, c);
  if constexpr (R == Reconstruction::first_order) return own;
  const double* arm = b.arm[i][side];
  T change = Rows<T>::slope(in, c, arm);
  if constexpr (R == Reconstruction::limited) {
    if (!boundary) {
      double across[3];  // from this cell's centroid to the other's
      for (int k = 0; k < 3; ++k) across[k] = arm[k] - b.arm[i][1 - side][k];
      const T difference = Rows<T>::cell(in, b.cell[1 - side][i]) - own;
      change = limited_fraction(Rows<T>::slope(in, c, across), difference, in.limiter_threshold) * change;
    }
  }
  const T at_face = own + change;
  // an extrapolation towards vacuum falls back to the cell's own state
  const auto too_low = [&](int k) { return Rows<T>::value(at_face, k) < 0.1 * Rows<T>::value(own, k); };
  return too_low(0) || too_low(4) ? own : at_face;
}

template <Reconstruction R, class T>
Side<T> face_side(const FaceInput& in, const mesh::FaceBlock& b, int side, bool boundary) {
  T rows[8], columns[8];
  for (int i = 0; i < 8; ++i) rows[i] = face_row<R, T>(in, b, i, side, boundary);
  Rows<T>::columns(rows, columns);
  return {{columns[0], columns[1], columns[2], columns[3], columns[4]}, columns[kMach]};
}

/// The part of a result that is summed: the value, or in linearised kernels the derivative.
inline Pack result(const Pack& x) { return x; }
inline Pack result(const Dual<Pack>& x) { return x.d; }

template <class T>
void flux_rows(const Flux<T>& f, const Pack& area, Pack rows[8]) {
  const Pack columns[8] = {area * result(f.mass),   area * result(f.x), area * result(f.y), area * result(f.z),
                           area * result(f.energy), Pack(0.0),          Pack(0.0),          Pack(0.0)};
  transpose(columns, rows);
}

inline void add(Row& row, const Pack& x) { (Pack::load(row.v) + x).store(row.v); }

/// Interior faces: rates[cell] += what leaves. T = Dual<Pack> gives the derivative along d_cells.
template <class FluxScheme, Reconstruction R, class T>
void sum_interior(const FaceInput& in, const mesh::FaceBlock* blocks, int count, Row* rates) {
  for (int k = 0; k < count; ++k) {
    const mesh::FaceBlock& b = blocks[k];
    const FaceGeometry face = face_geometry(in, b);
    const Side<T> l = face_side<R, T>(in, b, 0, false), r = face_side<R, T>(in, b, 1, false);
    const T mach = minimum(maximum(maximum(l.mach, r.mach), T(0.0)), T(1.0));
    Pack rows[8];
    flux_rows(FluxScheme::flux(l.state, r.state, face.normal, mach, in.gamma), face.area, rows);
    for (int i = 0; i < b.count; ++i) {
      add(rates[b.cell[0][i]], rows[i]);
      add(rates[b.cell[1][i]], -rows[i]);
    }
  }
}

template <class T>
State<T> boundary_state(BoundaryKind kind, const State<T>& s, const FaceInput& in, const FaceNormal<Pack>& n) {
  return kind == BoundaryKind::farfield ? farfield_state(s, in.far, n, in.gamma) : slip_state(s, n);
}

template <Reconstruction R, class T>
void sum_boundary(const FaceInput& in, BoundaryKind kind, const mesh::FaceBlock* blocks, int count, Row* rates) {
  for (int k = 0; k < count; ++k) {
    const mesh::FaceBlock& b = blocks[k];
    const FaceGeometry face = face_geometry(in, b);
    const State<T> inside = face_side<R, T>(in, b, 0, true).state;
    Pack rows[8];
    flux_rows(physical_flux(boundary_state(kind, inside, in, face.normal), face.normal, in.gamma), face.area, rows);
    for (int i = 0; i < b.count; ++i) add(rates[b.cell[0][i]], rows[i]);
  }
}

}  // namespace windhover::fluid
