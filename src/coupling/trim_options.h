// What a user says about a trim.
#pragma once
#include <optional>
#include <string>
#include <vector>

namespace windhover::coupling {

struct TrimOptions {
  std::vector<std::string> unknowns = {}, balance = {};
  double tolerance = 2e-3, mean_tolerance = 1e-3;
  std::optional<double> window_revolutions = {}, window_s = {};
  double ramp_windows = 0.5;
  int max_windows = 12, max_evaluations = 20;
  double force_scale_N = 0;
  double max_turn_deg = 10, max_speed_change = 0.2;
};

}  // namespace windhover::coupling
