// The controllers by name.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "control/airframe.h"
#include "control/control_options.h"
#include "control/controller.h"

namespace windhover::control {

std::vector<std::string> controller_names();

/// Throws UserError for options that do not fit the airframe; `prefix` is where the keys are, such as "controller.".
std::unique_ptr<Controller> make_controller(const ControllerOptions& options, const Airframe& airframe,
                                            const std::string& prefix = "controller.");

}  // namespace windhover::control
