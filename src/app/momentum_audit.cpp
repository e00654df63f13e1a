#include "app/momentum_audit.h"

#include "io/results.h"

namespace windhover::app {
namespace {

Vec3 total_momentum(const fluid::FlowSolver& solver) {
  const auto total = solver.euler().total(solver.state().q);
  return {total[1], total[2], total[3]};
}

}  // namespace

MomentumAudit::Forces MomentumAudit::forces(const fluid::FlowSolver& solver,
                                            const std::vector<fluid::PatchFlux>& fluxes) const {
  Forces forces;
  const auto& patches = solver.euler().mesh().patches;
  for (size_t p = 0; p < patches.size(); ++p) {
    (is_wall(case_, patches[p].name) ? forces.walls : forces.outer) +=
        Vec3(fluxes[p].flux.x, fluxes[p].flux.y, fluxes[p].flux.z);
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
          {"air_Ns", io::list(scale * air)},
          {"walls_Ns", io::list(scale * sum_.walls)},
          {"outer_Ns", io::list(scale * sum_.outer)},
          {"error", walls_ > 0 ? missing.norm() / walls_ : 0.0}};
}

}  // namespace windhover::app
