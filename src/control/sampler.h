// A controller that runs at samples and whose command is held between them.
#pragma once
#include <cstdint>
#include <vector>

#include "control/controller.h"

namespace windhover::control {

/// Everything that a sampled controller remembers; save and restore it with the state of the vehicle.
struct SampledState {
  std::int64_t next_sample = 0;
  std::vector<double> state;
  Command held;
};

class Sampler {
 public:
  Sampler(const Controller& controller, double rate_hz) : controller_(controller), rate_hz_(rate_hz) {}

  SampledState start() const {
    return {.next_sample = 0, .state = std::vector<double>(controller_.state_size()), .held = {}};
  }

  /// Sample k is at k / rate exactly, whatever the steps: stop the integration there.
  double next_time(const SampledState& s) const { return static_cast<double>(s.next_sample) / rate_hz_; }

  /// Takes the sample that is due.
  void sample(const Measurement& measurement, const Setpoint& setpoint, SampledState& s) const {
    std::vector<double> rate(s.state.size());
    s.held = controller_.evaluate(measurement, setpoint, s.state, rate);
    for (std::size_t i = 0; i < rate.size(); ++i) s.state[i] += rate[i] / rate_hz_;
    ++s.next_sample;
  }

 private:
  const Controller& controller_;
  double rate_hz_;
};

}  // namespace windhover::control
