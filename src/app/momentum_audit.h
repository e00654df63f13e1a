// Momentum that the air gained over a run against what passed through the boundaries: what the loads must agree with.
#pragma once
#include <nlohmann/json.hpp>

#include "app/scales.h"
#include "fluid/flow_solver.h"

namespace windhover::app {

class MomentumAudit {
 public:
  explicit MomentumAudit(const Case& c) : case_(c), scales_(c.fluid) {}

  /// At each accepted state; counts from the first at or after output.average_from_s. Collective.
  void add(const fluid::FlowSolver& solver, const std::vector<fluid::PatchFlux>& fluxes);

  /// N s in inertial axes, and the momentum that is missing relative to the sum over time of the walls' force; null before
  /// there are two states. Between states forces are linear in time.
  nlohmann::ordered_json result(const fluid::FlowSolver& solver) const;

 private:
  struct Forces {
    Vec3 walls = Vec3::Zero(),
         outer = Vec3::Zero();  ///< momentum that leaves the air per unit time; outer: all other boundaries
  };
  Forces forces(const fluid::FlowSolver& solver, const std::vector<fluid::PatchFlux>& fluxes) const;

  const Case& case_;
  Scales scales_;
  long states_ = 0;
  double from_ = 0;
  Vec3 momentum_ = Vec3::Zero();  ///< of the air at the first state
  Forces last_, sum_;
  double walls_ = 0;  ///< sum over time of the size of the walls' force
};

}  // namespace windhover::app
