// Position -> velocity -> attitude -> angular velocity -> mixer.
#pragma once
#include <memory>
#include <string>

#include "control/airframe.h"
#include "control/control_options.h"
#include "control/controller.h"

namespace windhover::control {

std::unique_ptr<Controller> make_cascade(const ControllerOptions& options, const Airframe& airframe,
                                         const std::string& prefix);

}  // namespace windhover::control
