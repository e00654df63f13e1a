// From a validated case to the objects of the flow solver, nondimensional.
#pragma once
#include "app/scales.h"
#include "fluid/flow_solver.h"
#include "fluid/initial.h"

namespace windhover::app {

fluid::FlowModel flow_model(const Case& c);
fluid::FlowOptions flow_options(const Case& c);
fluid::InitialState initial_state(const Case& c);

/// A rotation given in SI, nondimensional.
mesh::Rotation scaled(mesh::Rotation rotation, const Scales& scales);

/// The prescribed motion of the body, nondimensional.
mesh::Motion scaled_motion(const Case& c);

}  // namespace windhover::app
