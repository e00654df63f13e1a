// Rows of cells and their gradients: what faces read, from conserved states and from other ranks.
#include <algorithm>

#include "fluid/eight.h"
#include "fluid/euler.h"

namespace windhover::fluid {

using mesh::FrameState;
using mesh::Mat3;
using mesh::Vec3;

namespace {

/// M², squared speed relative to the moving cell over the speed of sound squared, led smoothly to its bound of 1:
/// a kink there stalls Newton's method in transonic flow.
template <class T, class G>
T bounded_mach_squared(const State<T>& s, const G grid[3], double gamma) {
  using std::sqrt;
  const T u = s.u - grid[0], v = s.v - grid[1], w = s.w - grid[2];
  const T m2 = (u * u + v * v + w * w) * s.rho * reciprocal(gamma * s.p), m4 = m2 * m2;
  return m2 * inverse_sqrt(sqrt(1.0 + m4 * m4));
}

/// Velocity of the zone's points: V + spin r with r in the zone's axes.
struct GridVelocity {
  Vec3 V;
  Mat3 spin;

  explicit GridVelocity(const FrameState& f) : V(f.V) {
    for (int k = 0; k < 3; ++k) spin.col(k) = f.omega.cross(f.R.col(k));
  }
  /// At eight points.
  template <class Number>
  void at(const Eight<3>& r, PackOf<Number> out[3]) const {
    PackOf<Number> x[8];
    load_columns(r, x);
    for (int i = 0; i < 3; ++i) out[i] = V[i] + spin(i, 0) * x[0] + spin(i, 1) * x[1] + spin(i, 2) * x[2];
  }
};

/// A state and its change when the conserved variables change so.
template <class P>
State<Dual<P>> with_derivative(const State<P>& s, const P change[kVariables], double gamma) {
  const P inverse = reciprocal(s.rho), &d_rho = change[0];
  const P d_kinetic = s.u * change[1] + s.v * change[2] + s.w * change[3] - 0.5 * d_rho * speed_squared(s);
  const auto speed = [&](const P& u, const P& d_momentum) { return Dual<P>(u, (d_momentum - u * d_rho) * inverse); };
  return {{s.rho, d_rho},
          speed(s.u, change[1]),
          speed(s.v, change[2]),
          speed(s.w, change[3]),
          {s.p, (gamma - 1.0) * (change[4] - d_kinetic)}};
}

template <class Number>
void store_rows(const State<PackOf<Number>>& s, const PackOf<Number>& mach_squared, int count, RowOf<Number>* out) {
  const PackOf<Number> columns[8] = {s.rho, s.u, s.v, s.w, s.p, mach_squared, 0.0, 0.0};
  PackOf<Number> rows[8];
  transpose(columns, rows);
  for (int j = 0; j < count; ++j) rows[j].store(out[j].v);
}

}  // namespace

/// The relative Mach numbers of eight cells where fluxes ask for them, else a constant.
template <class T>
T EulerOperator::mach_column(const State<T>& s, const PackFor<T> grid[3]) const {
  T column(1.0);
  if (model_.low_mach || model_.flux->needs_mach)
    for (int i = 0; i < PackFor<T>::kParts; ++i) {
      const typename RegisterOf<PackFor<T>>::type velocity[3] = {part(grid[0], i), part(grid[1], i), part(grid[2], i)};
      set_part(column, i, bounded_mach_squared(part(s, i), velocity, model_.gamma));
    }
  return column;
}

void EulerOperator::fill_cells(Vec q, const Frames& frames) {
  held_.content = {};
  held_.rate = held_.single = false;
  const double* values = nullptr;
  petsc(VecGetArrayRead(q, &values));
  for (size_t z = 0; z < frames.size(); ++z) {
    const GridVelocity grid_velocity(frames[z]);
    for (mesh::Index c = whole_.cells[z].begin; c < whole_.cells[z].end; c += 8) {
      const mesh::Index left = mesh_.n_owned - c;
      Pack grid[3], columns[8];
      grid_velocity.at(Eight<3>(mesh_.centroid[c].data(), left), grid);
      load_columns(Eight<5, double>(values + 5 * c, left), columns);
      const State<Pack> s = primitive(columns, model_.gamma);
      store_rows(s, mach_column(s, grid), std::min<int>(8, whole_.cells[z].end - c), &state_.cells[c]);
    }
  }
  petsc(VecRestoreArrayRead(q, &values));
}

/// Fills own rows of the derivative along dq; `turn` leads from the axes of dq.
template <class Number, class Scalar>
void EulerOperator::fill_derivatives(const Scalar* dq, const ZoneTurn& turn, const Extent& extent,
                                     const CellFields<Number>& state, CellFields<Number>& derivative) {
  using P = PackOf<Number>;
  for (size_t z = 0; z < held_.frames.size(); ++z) {
    const GridVelocity grid_velocity(held_.frames[z]);
    for (mesh::Index c = extent.cells[z].begin; c < extent.cells[z].end; c += 8) {
      const mesh::Index left = mesh_.n_owned - c;
      const int count = std::min<int>(8, extent.cells[z].end - c);
      P grid[3], along[8], rows[8], columns[8];
      grid_velocity.at(Eight<3>(mesh_.centroid[c].data(), left), grid);
      load_columns(Eight<5, Scalar>(dq + 5 * c, left), along);
      if (!turn.none()) {
        const Mat3& R = turn.forth(z);
        const P m[3] = {along[1], along[2], along[3]};
        for (int i = 0; i < 3; ++i) along[1 + i] = R(i, 0) * m[0] + R(i, 1) * m[1] + R(i, 2) * m[2];
      }
      for (int i = 0; i < 8; ++i) rows[i] = P::load(state.cells[c + std::min(i, count - 1)].v);
      transpose(rows, columns);
      const State<Dual<P>> s =
          with_derivative<P>({columns[0], columns[1], columns[2], columns[3], columns[4]}, along, model_.gamma);
      store_rows<Number>({s.rho.d, s.u.d, s.v.d, s.w.d, s.p.d}, mach_column(s, grid).d, count, &derivative.cells[c]);
    }
  }
}

template void EulerOperator::fill_derivatives(const double*, const ZoneTurn&, const Extent&, const CellFields<double>&, CellFields<double>&);
template void EulerOperator::fill_derivatives(const double*, const ZoneTurn&, const Extent&, const CellFields<float>&, CellFields<float>&);
template void EulerOperator::fill_derivatives(const float*, const ZoneTurn&, const Extent&, const CellFields<float>&, CellFields<float>&);

/// state_single_ becomes the state that is held.
void EulerOperator::round_state() {
  if (held_.single) return;
  if (state_single_.cells.empty()) {
    state_single_.resize(state_.cells.size(), state_.gradients.size());
    single_faces_.zones.assign(mesh_.faces.begin(), mesh_.faces.end());
    for (const mesh::Patch& p : mesh_.patches) single_faces_.patches.emplace_back(p.blocks.begin(), p.blocks.end());
  }
  const auto round = [](const auto& from, auto& to) {
    for (size_t i = 0; i < from.size(); ++i)
      for (size_t k = 0; k < std::size(from[i].v); k += 8)
        rounded_to<float>(Pack::load(from[i].v + k)).store(to[i].v + k);
  };
  round(state_.cells, state_single_.cells);
  round(state_.gradients, state_single_.gradients);
  held_.single = true;
}

/// Rows of neighbours' cells, and gradients, from own rows.
template <class Number>
void EulerOperator::complete(CellFields<Number>& fields) {
  halo_.begin(fields.cells.data());
  if (green_gauss_) green_gauss_->begin(fields.cells.data());
  halo_.end(fields.cells.data());
  if (green_gauss_) green_gauss_->end(fields.cells.data(), fields.gradients.data());
  if (least_squares_) least_squares_->apply(fields.cells.data(), fields.gradients.data());
}

void EulerOperator::complete_near_interfaces() {
  CellFields<float>& fields = near_->derivative;
  halo_.begin(fields.cells.data());
  halo_.end(fields.cells.data());
  if (green_gauss_) green_gauss_->apply(fields.cells.data(), fields.gradients.data(), near_->extent.gradients, near_->nodes);
  if (near_->least_squares) near_->least_squares->apply(fields.cells.data(), fields.gradients.data());
}

template <class Number>
void EulerOperator::begin_interfaces(CellFields<Number>& fields, const Frames& frames) {
  if (sliding_.empty()) return;
  mesh::RemoteRows& others = sliding_.others(frames);
  others.begin(fields.cells.data());
  if (!fields.gradients.empty()) others.begin(fields.gradients.data());
}

template <class Number>
void EulerOperator::end_interfaces(CellFields<Number>& fields, const Frames& frames) {
  if (sliding_.empty()) return;
  mesh::RemoteRows& others = sliding_.others(frames);
  others.end(fields.cells.data());
  if (!fields.gradients.empty()) others.end(fields.gradients.data());
}

#define WINDHOVER_FIELDS_OF(Number)                                                 \
  template void EulerOperator::complete(CellFields<Number>&);                       \
  template void EulerOperator::begin_interfaces(CellFields<Number>&, const Frames&); \
  template void EulerOperator::end_interfaces(CellFields<Number>&, const Frames&);
WINDHOVER_FIELDS_OF(double)
WINDHOVER_FIELDS_OF(float)
#undef WINDHOVER_FIELDS_OF

/// Rows of q, also of other ranks' cells at interfaces.
void EulerOperator::load_cells(Vec q, const Frames& frames) {
  if (holds(q, frames)) return;
  fill_cells(q, frames);
  halo_.begin(state_.cells.data());
  halo_.end(state_.cells.data());
  if (sliding_.empty()) return;
  mesh::RemoteRows& others = sliding_.others(frames);
  others.begin(state_.cells.data());
  others.end(state_.cells.data());
}

}  // namespace windhover::fluid
