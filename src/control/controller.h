// A controller is a law: measurement, setpoint and its own states in, command and the states' rates out.
#pragma once
#include <span>
#include <vector>

#include "control/signals.h"

namespace windhover::control {

class Controller {
 public:
  virtual ~Controller() = default;

  /// Integrators and filters, zero at the start: part of the vehicle's ODE, or advanced by a Sampler.
  virtual int state_size() const = 0;

  /// Pure. `rate` receives the time derivatives of `state`.
  virtual Command evaluate(const Measurement& measurement, const Setpoint& setpoint, std::span<const double> state,
                           std::span<double> rate) const = 0;

  /// The states with which the law gives this command, as far as it can: ask evaluate() what it gives with them.
  virtual std::vector<double> state_for(const Measurement& measurement, const Setpoint& setpoint,
                                        const Command& command) const = 0;
};

}  // namespace windhover::control
