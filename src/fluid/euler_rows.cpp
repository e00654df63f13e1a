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
T bounded_mach_squared(const State<T>& s, const Pack grid[3], double gamma) {
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

template <class T>
inline void make_rows(const T q[5], const Pack grid[3], bool use_mach, double gamma, T rows[8]) {
  const State<T> s = primitive(q, gamma);
  rows[0] = s.rho, rows[1] = s.u, rows[2] = s.v, rows[3] = s.w, rows[4] = s.p;
  rows[kMach] = use_mach ? bounded_mach_squared(s, grid, gamma) : T(1.0);
  rows[6] = rows[7] = T(0.0);
}

void store_rows(const Pack columns[8], int count, Row* out) {
  Pack rows[8];
  transpose(columns, rows);
  for (int j = 0; j < count; ++j) rows[j].store(out[j].v);
}

}  // namespace

/// Fills own rows from the conserved state, or from its derivative along *dq; `turn` leads from the axes of dq.
void EulerOperator::fill_cells(Vec q, const Frames& frames, const Vec* dq, std::vector<Row>& rows,
                               const ZoneTurn& turn) {
  const double *values = nullptr, *derivatives = nullptr;
  petsc(VecGetArrayRead(q, &values));
  if (dq) petsc(VecGetArrayRead(*dq, &derivatives));
  const bool use_mach = model_.low_mach || model_.flux->needs_mach;
  for (size_t z = 0; z < frames.size(); ++z) {
    const GridVelocity grid_velocity(frames[z]);
    for (mesh::Index c = zone_cells_[z].begin; c < zone_cells_[z].end; c += 8) {
      const mesh::Index left = mesh_.n_owned - c;
      const int count = std::min<int>(8, zone_cells_[z].end - c);
      Pack grid[3], columns[8], out[8];
      grid_velocity.at(Eight<3>(mesh_.centroid[c].data(), left), grid);
      load_columns(Eight<5>(values + 5 * c, left), columns);
      if (!dq) {
        make_rows(columns, grid, use_mach, model_.gamma, out);
      } else {
        Pack along[8];
        load_columns(Eight<5>(derivatives + 5 * c, left), along);
        if (!turn.none()) {
          const Mat3& R = turn.forth(z);
          const Pack m[3] = {along[1], along[2], along[3]};
          for (int i = 0; i < 3; ++i) along[1 + i] = R(i, 0) * m[0] + R(i, 1) * m[1] + R(i, 2) * m[2];
        }
        Dual<Pack> dual[5], rows_of_dual[8];
        for (int k = 0; k < 5; ++k) dual[k] = {columns[k], along[k]};
        make_rows(dual, grid, use_mach, model_.gamma, rows_of_dual);
        for (int k = 0; k < 8; ++k) out[k] = rows_of_dual[k].d;
      }
      store_rows(out, count, &rows[c]);
    }
  }
  petsc(VecRestoreArrayRead(q, &values));
  if (dq) petsc(VecRestoreArrayRead(*dq, &derivatives));
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
  fill_cells(q, frames, nullptr, cells_);
  exchange_halo(cells_);
  sliding_.begin_exchange(cells_.data(), row_type_);
  sliding_.end_exchange(cells_.data(), row_type_);
}

}  // namespace windhover::fluid
