// An ordinary differential equation as CVODE sees it.
#pragma once
#include <functional>
#include <span>

namespace windhover::body {

/// dy/dt = derivative(t, y); must be smooth in time over what one call of Integrator::advance covers.
struct Ode {
  std::function<void(double t, std::span<const double> y, std::span<double> rate)> derivative;
  std::function<void(std::span<double> y)> project;  ///< back onto the invariants of y; may be empty
};

}  // namespace windhover::body
