#include "app/momentum_audit.h"

namespace windhover::app {
namespace {

Vec3 total_momentum(const fluid::FlowSolver& solver) {
  const mesh::Mesh& mesh = solver.euler().mesh();
  const double* q = nullptr;
  petsc(VecGetArrayRead(solver.state().q, &q));
  Vec3 sum = Vec3::Zero();
  for (mesh::Index c = 0; c < mesh.n_owned; ++c)
    sum += mesh.volume[c] * Eigen::Map<const Vec3>(q + fluid::kVariables * c + 1);
  petsc(VecRestoreArrayRead(solver.state().q, &q));
  MPI_Allreduce(MPI_IN_PLACE, sum.data(), 3, MPI_DOUBLE, MPI_SUM, mesh.comm);
  return sum;
}

std::vector<double> list(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

MomentumAudit::Forces MomentumAudit::forces(const fluid::FlowSolver& solver,
                                            const std::vector<fluid::PatchFlux>& fluxes) const {
  Forces forces;
  const auto& patches = solver.euler().mesh().patches;
  for (size_t p = 0; p < patches.size(); ++p) {
    const auto condition = case_.fluid.boundary.find(patches[p].name);
    const bool wall = condition != case_.fluid.boundary.end() && condition->second == "wall";
    (wall ? forces.walls : forces.outer) += Vec3(fluxes[p].flux.x, fluxes[p].flux.y, fluxes[p].flux.z);
  }
  return forces;
}

void MomentumAudit::add(const fluid::FlowSolver& solver, const std::vector<fluid::PatchFlux>& fluxes) {
  const fluid::FlowState& state = solver.state();
  if (state.time * scales_.time() < case_.output.average_from_s) return;
  const Forces now = forces(solver, fluxes);
  if (states_++ == 0) {
    from_ = state.time;
    momentum_ = total_momentum(solver);
  } else {
    const double half = state.last_step / 2;
    sum_.walls += half * (last_.walls + now.walls);
    sum_.outer += half * (last_.outer + now.outer);
    walls_ += half * (last_.walls + now.walls).norm();
  }
  last_ = now;
}

nlohmann::ordered_json MomentumAudit::result(const fluid::FlowSolver& solver) const {
  if (states_ < 2) return nullptr;
  const double scale = scales_.force() * scales_.time();
  const Vec3 air = total_momentum(solver) - momentum_, missing = air + sum_.walls + sum_.outer;
  return {{"from_s", from_ * scales_.time()},
          {"air_Ns", list(scale * air)},
          {"walls_Ns", list(scale * sum_.walls)},
          {"outer_Ns", list(scale * sum_.outer)},
          {"error", walls_ > 0 ? missing.norm() / walls_ : 0.0}};
}

}  // namespace windhover::app
