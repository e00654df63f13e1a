// What a user says about the coupling of vehicle and air.
#pragma once
#include <string>

namespace windhover::coupling {

struct CouplingOptions {
  std::string scheme = "strong";
  std::string acceleration = "iqn-ils";
  double tolerance = 1e-3;
  double pose_tolerance = 1e-3;
  int max_iterations = 30;
  int newton_per_iteration = 1;
  double relaxation = 1;
  int columns = 8;
  int reuse_steps = 4;
  double filter = 1e-3;
  double force_scale_N = 0, moment_scale_Nm = 0;
  double step_tolerance = 0;
};

}  // namespace windhover::coupling
