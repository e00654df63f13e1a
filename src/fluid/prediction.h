// The first guess of a step, from the steps before.
#pragma once
#include "fluid/euler.h"
#include "fluid/flow_state.h"

namespace windhover::fluid {

/// out: pressure and velocity of the last three states (two, where there are no more) continued by dt, at the entropy of q_n:
/// a gas without shocks keeps it, and what Newton's method leaves of it in a small cell swings from step to step; along the line
/// it would come back up to three times as large. `now`: frames at t_n. state.last_step > 0.
void extend(const EulerOperator& euler, const FlowState& state, const Frames& now, double dt, Vec out);

}  // namespace windhover::fluid
