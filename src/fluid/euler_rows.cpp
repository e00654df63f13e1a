// Rows of cells and their gradients: what faces read, from conserved states and from other ranks.
#include <algorithm>

#include "fluid/euler.h"

namespace windhover::fluid {

using mesh::FrameState;
using mesh::Mat3;
using mesh::Vec3;

namespace {

/// Eight items of N numbers each, one after the other: those in the array, or a copy padded with zeros where fewer than
/// eight or what load_columns() reads after them would lie beyond the array's end.
template <int N>
struct Eight {
  double copy[8 * N + 8];
  const double* first;

  Eight(const double* data, mesh::Index left) : first(data) {
    if (N * left >= 7 * N + 8) return;
    std::fill(std::begin(copy), std::end(copy), 0.0);
    std::copy_n(data, N * std::min<mesh::Index>(left, 8), copy);
    first = copy;
  }
};

/// Eight items of N numbers each as columns, of which the first N mean something.
template <int N>
inline void load_columns(const Eight<N>& items, Pack columns[8]) {
  Pack rows[8];
  for (int j = 0; j < 8; ++j) rows[j] = Pack::load_unaligned(items.first + N * j);
  transpose(rows, columns);
}

/// M², squared speed relative to the moving cell over the speed of sound squared, led smoothly to its bound of 1:
/// a kink there stalls Newton's method in transonic flow.
template <class T>
T bounded_mach_squared(const State<T>& s, const Register grid[3], double gamma) {
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
  void at(const Eight<3>& r, Pack out[3]) const {
    Pack x[8];
    load_columns(r, x);
    for (int i = 0; i < 3; ++i) out[i] = V[i] + spin(i, 0) * x[0] + spin(i, 1) * x[1] + spin(i, 2) * x[2];
  }
};

/// A state and its change when the conserved variables change so.
State<Dual<Pack>> with_derivative(const State<Pack>& s, const Pack change[kVariables], double gamma) {
  const Pack inverse = reciprocal(s.rho), &d_rho = change[0];
  const Pack d_kinetic = s.u * change[1] + s.v * change[2] + s.w * change[3] - 0.5 * d_rho * speed_squared(s);
  const auto speed = [&](const Pack& u, const Pack& d_momentum) {
    return Dual<Pack>(u, (d_momentum - u * d_rho) * inverse);
  };
  return {{s.rho, d_rho},
          speed(s.u, change[1]),
          speed(s.v, change[2]),
          speed(s.w, change[3]),
          {s.p, (gamma - 1.0) * (change[4] - d_kinetic)}};
}

void store_rows(const State<Pack>& s, const Pack& mach_squared, int count, Row* out) {
  const Pack columns[8] = {s.rho, s.u, s.v, s.w, s.p, mach_squared, 0.0, 0.0};
  Pack rows[8];
  transpose(columns, rows);
  for (int j = 0; j < count; ++j) rows[j].store(out[j].v);
}

}  // namespace

/// The relative Mach numbers of eight cells where fluxes ask for them, else a constant.
template <class T>
T EulerOperator::mach_column(const State<T>& s, const Pack grid[3]) const {
  T column(1.0);
  if (model_.low_mach || model_.flux->needs_mach)
    for (int i = 0; i < Pack::kParts; ++i) {
      const Register velocity[3] = {part(grid[0], i), part(grid[1], i), part(grid[2], i)};
      set_part(column, i, bounded_mach_squared(part(s, i), velocity, model_.gamma));
    }
  return column;
}

void EulerOperator::fill_cells(Vec q, const Frames& frames) {
  held_.content = {};
  held_.rate = false;
  const double* values = nullptr;
  petsc(VecGetArrayRead(q, &values));
  for (size_t z = 0; z < frames.size(); ++z) {
    const GridVelocity grid_velocity(frames[z]);
    for (mesh::Index c = zone_cells_[z].begin; c < zone_cells_[z].end; c += 8) {
      const mesh::Index left = mesh_.n_owned - c;
      Pack grid[3], columns[8];
      grid_velocity.at(Eight<3>(mesh_.centroid[c].data(), left), grid);
      load_columns(Eight<5>(values + 5 * c, left), columns);
      const State<Pack> s = primitive(columns, model_.gamma);
      store_rows(s, mach_column(s, grid), std::min<int>(8, zone_cells_[z].end - c), &cells_[c]);
    }
  }
  petsc(VecRestoreArrayRead(q, &values));
}

/// Fills own rows of the derivative along dq; `turn` leads from the axes of dq.
void EulerOperator::fill_derivatives(Vec dq, const ZoneTurn& turn) {
  const double* derivatives = nullptr;
  petsc(VecGetArrayRead(dq, &derivatives));
  for (size_t z = 0; z < held_.frames.size(); ++z) {
    const GridVelocity grid_velocity(held_.frames[z]);
    for (mesh::Index c = zone_cells_[z].begin; c < zone_cells_[z].end; c += 8) {
      const mesh::Index left = mesh_.n_owned - c;
      const int count = std::min<int>(8, zone_cells_[z].end - c);
      Pack grid[3], along[8], rows[8], columns[8];
      grid_velocity.at(Eight<3>(mesh_.centroid[c].data(), left), grid);
      load_columns(Eight<5>(derivatives + 5 * c, left), along);
      if (!turn.none()) {
        const Mat3& R = turn.forth(z);
        const Pack m[3] = {along[1], along[2], along[3]};
        for (int i = 0; i < 3; ++i) along[1 + i] = R(i, 0) * m[0] + R(i, 1) * m[1] + R(i, 2) * m[2];
      }
      for (int i = 0; i < 8; ++i) rows[i] = Pack::load(cells_[c + std::min(i, count - 1)].v);
      transpose(rows, columns);
      const State<Dual<Pack>> s =
          with_derivative({columns[0], columns[1], columns[2], columns[3], columns[4]}, along, model_.gamma);
      store_rows({s.rho.d, s.u.d, s.v.d, s.w.d, s.p.d}, mach_column(s, grid).d, count, &d_cells_[c]);
    }
  }
  petsc(VecRestoreArrayRead(dq, &derivatives));
}

void EulerOperator::exchange_halo(std::vector<Row>& rows) const {
  petsc(PetscSFBcastBegin(mesh_.halo, row_type_, rows.data(), rows.data(), MPI_REPLACE));
  petsc(PetscSFBcastEnd(mesh_.halo, row_type_, rows.data(), rows.data(), MPI_REPLACE));
}

void EulerOperator::update_gradients(const std::vector<Row>& rows, std::vector<GradientRow>& gradients) const {
  if (green_gauss_) green_gauss_->apply(rows.data(), gradients.data());
  if (least_squares_) least_squares_->apply(rows.data(), gradients.data());
}

void EulerOperator::begin_interfaces(std::vector<Row>& rows, std::vector<GradientRow>& gradients) const {
  sliding_.begin_exchange(rows.data(), row_type_);
  if (!gradients.empty()) sliding_.begin_exchange(gradients.data(), gradient_type_);
}

void EulerOperator::end_interfaces(std::vector<Row>& rows, std::vector<GradientRow>& gradients) const {
  sliding_.end_exchange(rows.data(), row_type_);
  if (!gradients.empty()) sliding_.end_exchange(gradients.data(), gradient_type_);
}

/// Rows of q, also of other ranks' cells at interfaces.
void EulerOperator::load_cells(Vec q, const Frames& frames) {
  if (holds(q, frames)) return;
  fill_cells(q, frames);
  exchange_halo(cells_);
  sliding_.begin_exchange(cells_.data(), row_type_);
  sliding_.end_exchange(cells_.data(), row_type_);
}

}  // namespace windhover::fluid
