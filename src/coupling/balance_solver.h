// Newton's method for functions that cost a flow each: KINSOL with a Jacobian that is modelled once and then learns.
#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace windhover::coupling {

using VectorXd = Eigen::VectorXd;
using MatrixXd = Eigen::MatrixXd;

/// F(u) = 0 with as many equations as unknowns, both scaled: steps are limited to 1 in each unknown, sizes compared in F.
class BalanceProblem {
 public:
  virtual ~BalanceProblem() = default;
  /// F at u, or nothing: stop.
  virtual std::optional<VectorXd> evaluate(const VectorXd& u) = 0;
  /// How far the latest F may be from what it would be in the end, in its largest component.
  virtual double uncertainty() const { return 0; }
  /// A guess of dF/du at the latest u evaluated; a column of zeros is found by a difference instead.
  virtual MatrixXd model_jacobian() = 0;
};

struct BalanceOptions {
  double tolerance = 1e-3;  ///< of the largest component of F
  int max_evaluations = 20;
  std::vector<bool> positive = {};  ///< unknowns that must stay above 0; empty: none
};

struct BalanceResult {
  bool converged = false, stopped = false;  ///< stopped: by the problem
  std::string reason;                       ///< when not converged
  VectorXd u;                               ///< the latest evaluated
  int evaluations = 0;
};

/// Newton's method (KINSOL, steps limited, no line search); after each evaluation the Jacobian is corrected so that it
/// explains the latest change of F (Broyden, Math. Comp. 19, 1965), unless that is lost in the uncertainty. Passes on what
/// evaluate() throws.
BalanceResult solve_balance(BalanceProblem& problem, const VectorXd& start, const BalanceOptions& options);

}  // namespace windhover::coupling
