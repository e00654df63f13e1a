// CVODE over one window: state in, state out.
#pragma once

#include <memory>
#include <string>

#include "base/sundials.h"
#include "body/ode.h"

namespace windhover::body {

struct IntegratorOptions {
  std::string method = "bdf";
  double relative_tolerance = 1e-9, absolute_tolerance = 1e-12;
  int max_steps = 100000;
};

class Integrator {
 public:
  explicit Integrator(const IntegratorOptions& options);

  /// Advances y from t0 to exactly t1. Every call starts CVODE afresh, so that a call with the same arguments repeats
  /// bit for bit; where the right-hand side jumps (samples, step ends), end the call. y is unchanged when it throws:
  /// what the right-hand side threw, or SolverFailure.
  void advance(const Ode& ode, double t0, double t1, std::span<double> y) const;

 private:
  IntegratorOptions options_;
  sundials::Context context_;
};

}  // namespace windhover::body
