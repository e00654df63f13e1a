// What can solve a stage, by name.
#pragma once
#include "fluid/dual_time.h"
#include "fluid/newton.h"

namespace windhover::fluid {

struct StageMethod {
  const char* name;
  std::unique_ptr<StageSolver> (*make)(EulerOperator& euler, const NewtonOptions& newton,
                                       const DualTimeOptions& dual_time);
};

/// newton_krylov, dual_time.
extern const StageMethod kStageMethods[2];

}  // namespace windhover::fluid
