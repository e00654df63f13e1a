// A prescribed value in time: steady, ramp and one harmonic.
#pragma once
#include <cmath>

namespace windhover {

/// value(t) = mean + rate t + amplitude sin(omega t + phase); any units.
struct Signal {
  double mean = 0, rate = 0, amplitude = 0, omega = 0, phase = 0;

  double value(double t) const { return mean + rate * t + amplitude * std::sin(omega * t + phase); }
  double derivative(double t) const { return rate + amplitude * omega * std::cos(omega * t + phase); }
  double second_derivative(double t) const { return -amplitude * omega * omega * std::sin(omega * t + phase); }
};

}  // namespace windhover
