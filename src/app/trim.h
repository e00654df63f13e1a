// `windhover trim`: the attitude and rotor speeds, or mount positions, at which the mean forces on a vehicle vanish.
#pragma once
#include "app/case.h"

namespace windhover::app {

/// UserError unless the case can be trimmed; before the mesh is read.
void validate_trim(const Case& c);

/// Writes its results to `out`, or, when that is empty, to output.directory + "_trim". Returns the exit code: 0, or
/// 128 + signal when interrupted. SolverFailure when there is no balance; what there is is saved. Collective.
int run_trim(const Case& c, const std::string& out);

}  // namespace windhover::app
