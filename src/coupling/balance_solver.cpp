#include "coupling/balance_solver.h"

#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <Eigen/LU>
#include <cmath>

#include "base/errors.h"
#include "base/petsc.h"
#include "coupling/kinsol.h"

namespace windhover::coupling {
namespace {

/// Change of a scaled unknown for a difference.
constexpr double kDifference = 0.1;
/// Surprises of F that tell of the Jacobian are this many times the uncertainty.
constexpr double kSignificant = 3;
/// KINSOL calls steps below this no progress; the tolerance on F is what ends the search.
constexpr double kLeastStep = 1e-8;

/// The function with its Jacobian, which learns from every evaluation.
class Learner {
 public:
  Learner(BalanceProblem& problem, const BalanceOptions& options) : problem_(problem), options_(options) {}

  /// F(u), or nothing: the problem has stopped, or evaluations are used up.
  std::optional<VectorXd> evaluate(const VectorXd& u) {
    if (evaluations > 0 && u == this->u) return f;
    if (evaluations == options_.max_evaluations) {
      exhausted = true;
      return {};
    }
    const auto f = problem_.evaluate(u);
    if (!f) {
      stopped = true;
      return {};
    }
    ++evaluations;
    const double uncertainty = problem_.uncertainty() + uncertainty_;
    if (J_.size() > 0) correct(u - this->u, *f - this->f, uncertainty);
    uncertainty_ = problem_.uncertainty();
    this->u = u;
    this->f = *f;
    return f;
  }

  /// Nothing: stopped on the way to a difference.
  std::optional<MatrixXd> jacobian() {
    if (J_.size() > 0) return J_;
    MatrixXd J = problem_.model_jacobian();
    for (Eigen::Index k = 0; k < J.cols(); ++k) {
      if (J.col(k).norm() > 0) continue;
      const VectorXd u0 = u, f0 = f;
      const auto f1 = evaluate(u0 + kDifference * VectorXd::Unit(u0.size(), k));
      if (!f1) return {};
      J.col(k) = (*f1 - f0) / kDifference;
      u = u0;
      f = f0;
    }
    const Eigen::FullPivLU<MatrixXd> lu(J);
    if (!lu.isInvertible())
      throw SolverFailure(
          "trim: the unknowns cannot balance the forces: some combination of them changes none of these");
    J_ = J;
    return J_;
  }

  int evaluations = 0;
  bool stopped = false, exhausted = false;
  VectorXd u, f;  ///< the latest

 private:
  /// A surprise that is lost in the uncertainty says nothing of that force's row of the Jacobian.
  void correct(const VectorXd& du, const VectorXd& df, double uncertainty) {
    const VectorXd surprise = df - J_ * du;
    J_ += (surprise.array().abs() > kSignificant * uncertainty).select(surprise, 0) * du.transpose() / du.squaredNorm();
  }

  BalanceProblem& problem_;
  const BalanceOptions& options_;
  MatrixXd J_;
  double uncertainty_ = 0;
};

/// What KINSOL's callbacks share.
struct Shared {
  Learner learner;
  CallbackGuard guard = {};
};

int function(N_Vector u, N_Vector f, void* data) {
  Shared& shared = *static_cast<Shared*>(data);
  bool done = false;
  const int failed = shared.guard.run([&] {
    const auto answer = shared.learner.evaluate(values(u));
    if (answer) values(f) = *answer;
    done = answer.has_value();
  });
  return failed || !done ? -1 : 0;
}

int jacobian(N_Vector, N_Vector, SUNMatrix matrix, void* data, N_Vector, N_Vector) {
  Shared& shared = *static_cast<Shared*>(data);
  bool done = false;
  const int failed = shared.guard.run([&] {
    const auto J = shared.learner.jacobian();
    if (J) MatrixXd::Map(SUNDenseMatrix_Data(matrix), J->rows(), J->cols()) = *J;  // both by columns
    done = J.has_value();
  });
  return failed || !done ? -1 : 0;
}

void keep_message(int code, const char*, const char*, char* message, void* data) {
  if (code < 0) *static_cast<std::string*>(data) = message;
}

std::string reason(int flag, const Learner& learner, const std::string& message) {
  if (learner.exhausted) return fmt::format("no balance after {} tries", learner.evaluations);
  return fmt::format("KINSOL: {} ({})", KINGetReturnFlagName(flag), message);
}

/// KINSOL from the start, which has been evaluated; returns its flag.
int run_kinsol(Shared& shared, const VectorXd& start, const BalanceOptions& options, std::string& message) {
  const auto n = static_cast<sunindextype>(start.size());
  const sundials::Context context = sundials::make_context();
  const sundials::Vector u(N_VNew_Serial(n, context.get())), one(N_VNew_Serial(n, context.get())),
      constraints(N_VNew_Serial(n, context.get()));
  values(u.get()) = start;
  N_VConst(1.0, one.get());
  constexpr double kPositive = 2, kFree = 0;
  for (Eigen::Index i = 0; i < n; ++i)
    values(constraints.get())[i] = !options.positive.empty() && options.positive[i] ? kPositive : kFree;
  const sundials::Matrix matrix(SUNDenseMatrix(n, n, context.get()));
  const sundials::LinearSolver solver(SUNLinSol_Dense(u.get(), matrix.get(), context.get()));
  const Kinsol kinsol(KINCreate(context.get()));
  void* k = kinsol.get();
  check(KINInit(k, function, u.get()));
  check(KINSetErrHandlerFn(k, keep_message, &message));
  check(KINSetUserData(k, &shared));
  check(KINSetLinearSolver(k, solver.get(), matrix.get()));
  check(KINSetJacFn(k, jacobian));
  check(KINSetMaxSetupCalls(k, 1));  // the Jacobian has learned: take it each time
  check(KINSetNumMaxIters(k, options.max_evaluations + 1));
  check(KINSetMaxNewtonStep(k, std::sqrt(static_cast<double>(n))));
  check(KINSetFuncNormTol(k, options.tolerance));
  check(KINSetScaledStepTol(k, kLeastStep));
  check(KINSetConstraints(k, constraints.get()));
  return KINSol(k, u.get(), KIN_NONE, one.get(), one.get());
}

}  // namespace

BalanceResult solve_balance(BalanceProblem& problem, const VectorXd& start, const BalanceOptions& options) {
  Shared shared{{problem, options}};
  BalanceResult result;
  const auto first = shared.learner.evaluate(start);
  result.converged = first && first->lpNorm<Eigen::Infinity>() <= options.tolerance;
  if (first && !result.converged) {
    std::string message;
    int flag = KIN_MXNEWT_5X_EXCEEDED;  // five steps as long as allowed: no reason not to go on
    for (VectorXd from = start; flag == KIN_MXNEWT_5X_EXCEEDED; from = shared.learner.u)
      flag = run_kinsol(shared, from, options, message);
    shared.guard.rethrow();
    result.converged = flag == KIN_SUCCESS || flag == KIN_INITIAL_GUESS_OK;
    if (!result.converged) result.reason = reason(flag, shared.learner, message);
  }
  result.stopped = shared.learner.stopped;
  result.u = first ? shared.learner.u : start;
  result.evaluations = shared.learner.evaluations;
  return result;
}

}  // namespace windhover::coupling
