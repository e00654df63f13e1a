#include "fluid/euler.h"

#include <algorithm>
#include <cstring>

#include "base/errors.h"
// needs PETSc's types before it
#include <petsc/private/petscimpl.h>

namespace windhover::fluid {

using mesh::FrameState;
using mesh::Range;
using mesh::Vec3;

namespace {

std::vector<std::optional<BoundaryKind>> resolve_patches(const mesh::Mesh& mesh, const FlowModel& model,
                                                         const SlidingFaces& sliding) {
  std::vector<std::optional<BoundaryKind>> kinds;
  for (size_t p = 0; p < mesh.patches.size(); ++p) {
    const auto& patch = mesh.patches[p];
    const auto found = model.boundary.find(patch.name);
    const bool slides = sliding.covers(static_cast<int>(p));
    if (slides && found != model.boundary.end())
      throw UserError("fluid.boundary: '{}' is a sliding interface and can have no boundary condition", patch.name);
    if (!slides && found == model.boundary.end())
      throw UserError("fluid.boundary: the mesh's surface '{}' has no boundary condition (wall, symmetry or farfield)",
                      patch.name);
    kinds.push_back(slides ? std::nullopt : std::optional(found->second));
  }
  for (const auto& [name, kind] : model.boundary)
    if (std::none_of(mesh.patches.begin(), mesh.patches.end(), [&](const auto& p) { return p.name == name; }))
      throw UserError("fluid.boundary: '{}' is not a surface of the mesh", name);
  return kinds;
}

}  // namespace

VecContent::VecContent(Vec v) {
  petsc(PetscObjectGetId(reinterpret_cast<PetscObject>(v), &id));
  petsc(PetscObjectStateGet(reinterpret_cast<PetscObject>(v), &state));
}

EulerOperator::EulerOperator(const mesh::Mesh& mesh, FlowModel model, std::vector<mesh::SlidingInterface> interfaces)
    : mesh_(mesh),
      model_(std::move(model)),
      sliding_(mesh_, std::move(interfaces)),
      halo_(mesh_.comm, mesh_.halo),
      patch_kind_(resolve_patches(mesh_, model_, sliding_)),
      whole_(Extent::whole(mesh_)) {
  // with interfaces, the rows of other ranks' cells come after all of the mesh's
  const mesh::Index n_sides = sliding_.empty() ? mesh_.n_gradient : sliding_.n_cells();
  if (model_.reconstruction != Reconstruction::first_order) {
    if (model_.gradient == GradientKind::green_gauss)
      green_gauss_.emplace(mesh_);
    else
      least_squares_.emplace(mesh_);
  }
  state_.resize(sliding_.n_cells(), model_.reconstruction != Reconstruction::first_order ? n_sides : 0);
  rates_.resize(n_sides);
}

VecHandle EulerOperator::make_vector() const {
  VecHandle v;
  petsc(VecCreateMPI(mesh_.comm, kVariables * mesh_.n_owned, PETSC_DETERMINE, v.out()));
  petsc(VecSetBlockSize(v, kVariables));
  return v;
}

FaceInput EulerOperator::face_input(const FrameState& frame, const Extent& extent) const {
  FaceInput in;
  in.rows = {state_.rows(derivative_), state_single_.rows(&extent == &whole_ ? derivative_single_ : near_->derivative)};
  const Vec3 V = frame.R.transpose() * frame.V, omega = frame.R.transpose() * frame.omega;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) in.rotation[3 * i + j] = frame.R(i, j);
    in.velocity[i] = V[i];
    in.angular_velocity[i] = omega[i];
  }
  in.gamma = model_.gamma;
  in.limiter_threshold = model_.limiter_epsilon * model_.limiter_epsilon;
  in.far = model_.far;
  return in;
}

/// Leaves the rates at zero for the next sum, while they are in the cache. `turn` leads from the axes of x and out. `rate`:
/// gets R alone.
template <class Number, class Scalar>
void EulerOperator::store_rates(const Scalar* x, Scalar* out, const Combination& combination, const Extent& extent,
                                const ZoneTurn& turn, double* rate) {
  RowOf<Number>* const rates = this->rates<Number>();
  const double* known = nullptr;
  if (combination.known) petsc(VecGetArrayRead(combination.known, &known));
  Pack axes[3] = {0.0, 0.0, 0.0};  // columns of the zone's matrix, where the momentum is
  alignas(64) constexpr double scalars[8] = {1, 0, 0, 0, 1};
  const auto combine = [&](mesh::Index c, auto columns) {
    const auto load = [=]<class S>(const S* from) {
      PackOf<S> five(0.0);
      std::memcpy(&five, from + kVariables * c, columns * sizeof(S));
      return widened(five);
    };
    const auto store = [=]<class S>(const Pack& from, S* to) {
      const PackOf<S> five = rounded_to<S>(from);
      std::memcpy(to + kVariables * c, &five, columns * sizeof(S));
    };
    const Pack own = widened(PackOf<Number>::load(rates[c].v));
    if (rate) store(own, rate);
    Pack sum = combination.rate * own;
    if (!turn.none()) sum = Pack::load(scalars) * sum + axes[0] * sum[1] + axes[1] * sum[2] + axes[2] * sum[3];
    PackOf<Number>(0.0).store(rates[c].v);
    sum += combination.mass * mesh_.volume[c] * load(x);
    if (known) sum += load(known);
    store(sum, out);
  };
  // whole registers spill over the next cell, which comes after; the last cell must not
  const mesh::Index safe = std::max<mesh::Index>(0, mesh_.n_owned - 1);
  for (size_t z = 0; z < extent.cells.size(); ++z) {
    for (int k = 0; k < 3 && !turn.none(); ++k)
      for (int i = 0; i < 3; ++i) axes[k].set(1 + i, turn.back(z)(i, k));
    const Range& zone = extent.cells[z];
    for (mesh::Index c = zone.begin; c < std::min(zone.end, safe); ++c) combine(c, std::integral_constant<int, 8>());
    for (mesh::Index c = std::max(zone.begin, safe); c < zone.end; ++c)
      combine(c, std::integral_constant<int, kVariables>());
  }
  for (const mesh::Index c : extent.touched) rates[c] = {};
  std::fill(rates + mesh_.n_owned, rates + rates_.size(), RowOf<Number>{});
  if (combination.known) petsc(VecRestoreArrayRead(combination.known, &known));
}

bool EulerOperator::holds(Vec q, const Frames& frames) const {
  return held_.content == VecContent(q) && held_.frames == frames;
}

void EulerOperator::hold(Vec q, const Frames& frames) {
  held_.content = VecContent(q);
  held_.frames = frames;
}

/// Rows and gradients of q; not of other ranks' cells at interfaces, unless they are held.
void EulerOperator::prepare(Vec q, const Frames& frames) {
  if (holds(q, frames)) return;
  fill_cells(q, frames);
  complete(state_);
}

/// From rows and gradients of the cells. The zones' own faces and boundaries come while other ranks' rows at interfaces are under way.
template <class Number>
void EulerOperator::sum_rates(CellFields<Number>& fields, const Frames& frames, const Extent& extent,
                              FluxKernels::Sum<Number> interior, BoundaryKernels::Sum<Number> boundary) {
  RowOf<Number>* const rates = this->rates<Number>();
  begin_interfaces(fields, frames);
  const auto between_cells = [&](const FaceInput& in, const auto* blocks, int n) { interior(in, blocks, n, rates); };
  for_each_zone<Number>(frames, extent, between_cells);
  for_each_patch<Number>(frames, extent, [&](const FaceInput& in, BoundaryKind kind, const auto* blocks, int n, int) {
    boundary(in, kind, blocks, n, rates);
  });
  end_interfaces(fields, frames);
  for_each_interface<Number>(frames, extent, between_cells);
}

void EulerOperator::keep_rates() {
  if (!rate_) rate_ = make_vector();
}

void EulerOperator::residual(Vec q, const Frames& frames, Vec out, const Combination& combination) {
  const bool alone = combination.mass == 0 && combination.rate == 1 && !combination.known;
  if (alone && held_.rate && holds(q, frames)) {
    petsc(VecCopy(rate_, out));
    return;
  }
  fill_cells(q, frames);
  const int r = static_cast<int>(model_.reconstruction);
  complete(state_);
  sum_rates(state_, frames, whole_, model_.flux->residual[r], kBoundaryKernels.residual[r]);
  const double* from = nullptr;
  double *to = nullptr, *rate = nullptr;
  petsc(VecGetArrayRead(q, &from));
  petsc(VecGetArrayWrite(out, &to));
  if (rate_) petsc(VecGetArrayWrite(rate_, &rate));
  store_rates<double>(from, to, combination, whole_, {}, rate);
  if (rate_) petsc(VecRestoreArrayWrite(rate_, &rate));
  petsc(VecRestoreArrayWrite(out, &to));
  petsc(VecRestoreArrayRead(q, &from));
  hold(q, frames);
  held_.rate = rate_;
}

void EulerOperator::linearize(Vec q, const Frames& frames) {
  if (!holds(q, frames)) {
    prepare(q, frames);
    begin_interfaces(state_, frames);
    end_interfaces(state_, frames);
    hold(q, frames);
  }
}

template <class Number, class Scalar>
void EulerOperator::derivative_of(const Scalar* dq, Scalar* out, const Combination& combination, const ZoneTurn& turn) {
  const int r = static_cast<int>(model_.reconstruction);
  const auto sum = [&](const CellFields<Number>& state, CellFields<Number>& along, const auto& interior,
                       const auto& boundary) {
    if (along.cells.empty()) along.resize(state_.cells.size(), state_.gradients.size());
    fill_derivatives(dq, turn, whole_, state, along);
    complete(along);
    sum_rates(along, held_.frames, whole_, interior[r], boundary[r]);
    store_rates<Number>(dq, out, combination, whole_, turn);
  };
  if constexpr (std::is_same_v<Number, float>) {
    round_state();
    sum(state_single_, derivative_single_, model_.flux->derivative_single, kBoundaryKernels.derivative_single);
  } else {
    sum(state_, derivative_, model_.flux->derivative, kBoundaryKernels.derivative);
  }
}

void EulerOperator::derivative(Vec dq, Vec out, const Combination& combination, const ZoneTurn& turn, bool single) {
  const double* from = nullptr;
  double* to = nullptr;
  petsc(VecGetArrayRead(dq, &from));
  petsc(VecGetArrayWrite(out, &to));
  if (single)
    derivative_of<float>(from, to, combination, turn);
  else
    derivative_of<double>(from, to, combination, turn);
  petsc(VecRestoreArrayWrite(out, &to));
  petsc(VecRestoreArrayRead(dq, &from));
}

void EulerOperator::derivative(const float* dq, float* out, const Combination& combination, const ZoneTurn& turn) {
  derivative_of<float>(dq, out, combination, turn);
}

void EulerOperator::set_near_interfaces(int layers) {
  Near& near = near_.emplace();
  near.extent = Extent::near(mesh_, sliding_.own_cells(), layers);
  if (green_gauss_) near.nodes = green_gauss_->nodes_of(near.extent.gradients);
  if (least_squares_) near.least_squares.emplace(mesh_, near.extent.gradients);
  near.derivative.resize(state_.cells.size(), state_.gradients.size());
}

void EulerOperator::derivative_near_interfaces(const float* dq, float* out, const Combination& combination, const ZoneTurn& turn) {
  const int r = static_cast<int>(model_.reconstruction);
  round_state();
  fill_derivatives(dq, turn, near_->extent, state_single_, near_->derivative);
  complete_near_interfaces();
  sum_rates(near_->derivative, held_.frames, near_->extent, model_.flux->derivative_single[r], kBoundaryKernels.derivative_single[r]);
  store_rates<float>(dq, out, combination, near_->extent, turn);
}

}  // namespace windhover::fluid
