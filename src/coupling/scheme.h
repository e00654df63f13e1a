// What a coupling scheme is: a way to solve x = G(x) for the loads x at the end of a step.
#pragma once
#include <Eigen/Core>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "coupling/coupling_options.h"

namespace windhover::coupling {

using Eigen::VectorXd;

/// G: the vehicle moves under the loads x, the air answers with G(x). It counts, judges and says when to stop.
class FixedPoint {
 public:
  virtual ~FixedPoint() = default;
  /// G(x), or nothing: stop, the step is either good or lost. `relaxation` is what led to x, for the table.
  virtual std::optional<VectorXd> evaluate(const VectorXd& x, double relaxation) = 0;
  /// The latest G(x) comes from a flow that is solved to its tolerance.
  virtual bool flow_converged() const = 0;
  /// Sizes of the components of x: what makes forces and moments comparable.
  virtual const VectorXd& scale() const = 0;
  /// Differences below this, relative to the scale, tell nothing.
  virtual double tolerance() const = 0;
};

class Scheme {
 public:
  virtual ~Scheme() = default;
  /// Proposes x after x, the first as given, until the fixed point says stop.
  virtual void solve(VectorXd x, FixedPoint& fixed_point) = 0;
  virtual void accept() {}
  virtual void reject() {}
  /// What is carried from step to step, for a restart.
  virtual std::vector<double> state() const { return {}; }
  virtual void restore(std::span<const double>) {}
};

/// `size` of x; `motions`: how many of the vehicle's motions answer to x.
std::unique_ptr<Scheme> make_single_pass(const CouplingOptions& options, int size, int motions);
std::unique_ptr<Scheme> make_constant(const CouplingOptions& options, int size, int motions);
std::unique_ptr<Scheme> make_aitken(const CouplingOptions& options, int size, int motions);
std::unique_ptr<Scheme> make_anderson(const CouplingOptions& options, int size, int motions);
std::unique_ptr<Scheme> make_iqn_ils(const CouplingOptions& options, int size, int motions);

}  // namespace windhover::coupling
