// The flow as blocks for ParaView: a block per zone, a block per wall patch, in SI and where they are at the time.
#pragma once
#include "app/scales.h"
#include "fluid/flow_solver.h"
#include "io/fields.h"

namespace windhover::app {

std::vector<io::FieldBlock> flow_fields(const Case& c, fluid::FlowSolver& solver, const fluid::Frames& frames);

}  // namespace windhover::app
