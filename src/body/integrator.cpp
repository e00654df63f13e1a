#include "body/integrator.h"

#include <cvode/cvode.h>
#include <cvode/cvode_proj.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <cmath>
#include <vector>

#include "base/errors.h"
#include "base/petsc.h"

namespace windhover::body {
namespace {

using sundials::values;
using Cvode = std::unique_ptr<void, sundials::ReleaseMemory<CVodeFree>>;

/// What the callbacks share.
struct Problem {
  const Ode& ode;
  std::vector<double> scratch;
  CallbackGuard guard = {};
  std::string message = {};
};

constexpr int kUnrecoverable = -1;

/// Windows shorter than this part of the time itself, between a sample and a step end that rounding has set apart, are
/// no work for CVODE: one Euler step is exact to far below round-off.
constexpr double kInstant = 1e-13;

int derivative(double t, N_Vector y, N_Vector rate, void* data) {
  Problem& problem = *static_cast<Problem*>(data);
  return problem.guard.run([&] { problem.ode.derivative(t, values(y), values(rate)); }) ? kUnrecoverable : 0;
}

int project(double, N_Vector y, N_Vector correction, double, N_Vector, void* data) {
  Problem& problem = *static_cast<Problem*>(data);
  const int failed = problem.guard.run([&] {
    const std::span<double> old = values(y), change = values(correction);
    problem.scratch.assign(old.begin(), old.end());
    problem.ode.project(problem.scratch);
    for (std::size_t i = 0; i < old.size(); ++i) change[i] = problem.scratch[i] - old[i];
  });
  return failed ? kUnrecoverable : 0;
}

void keep_message(int code, const char*, const char*, char* message, void* data) {
  if (code < 0) static_cast<Problem*>(data)->message = message;
}

void euler_step(const Ode& ode, double t0, double t1, std::span<double> y) {
  std::vector<double> rate(y.size());
  ode.derivative(t0, y, rate);
  for (std::size_t i = 0; i < y.size(); ++i) y[i] += (t1 - t0) * rate[i];
}

void check(int flag) {
  if (flag < 0) throw std::runtime_error(fmt::format("CVODE: error {} in its set-up", flag));
}

}  // namespace

Integrator::Integrator(const IntegratorOptions& options) : options_(options), context_(sundials::make_context()) {}

void Integrator::advance(const Ode& ode, double t0, double t1, std::span<double> y) const {
  if (y.empty()) return;
  if (t1 - t0 <= kInstant * std::abs(t1)) return euler_step(ode, t0, t1, y);
  const auto n = static_cast<sunindextype>(y.size());
  const bool bdf = options_.method == "bdf";
  Problem problem{ode, {}};
  const sundials::Vector state(N_VNew_Serial(n, context_.get()));
  std::copy(y.begin(), y.end(), values(state.get()).begin());
  const sundials::Matrix matrix(SUNDenseMatrix(n, n, context_.get()));
  const sundials::LinearSolver solver(SUNLinSol_Dense(state.get(), matrix.get(), context_.get()));
  const Cvode cvode(CVodeCreate(bdf ? CV_BDF : CV_ADAMS, context_.get()));

  check(CVodeInit(cvode.get(), derivative, t0, state.get()));
  check(CVodeSetErrHandlerFn(cvode.get(), keep_message, &problem));
  check(CVodeSetUserData(cvode.get(), &problem));
  check(CVodeSStolerances(cvode.get(), options_.relative_tolerance, options_.absolute_tolerance));
  check(CVodeSetMaxNumSteps(cvode.get(), options_.max_steps));
  check(CVodeSetLinearSolver(cvode.get(), solver.get(), matrix.get()));
  check(CVodeSetStopTime(cvode.get(), t1));
  if (bdf && ode.project) {  // CVODE projects with BDF only; with Adams the end of the window has to do
    check(CVodeSetProjFn(cvode.get(), project));
    check(CVodeSetProjErrEst(cvode.get(), false));
  }

  double reached = t0;
  const int flag = CVode(cvode.get(), t1, state.get(), &reached, CV_NORMAL);
  problem.guard.rethrow();
  if (flag < 0)
    throw SolverFailure("body: CVODE gave up at t = {} s of the window from {} s to {} s: {}", reached, t0, t1,
                        problem.message);
  if (ode.project) ode.project(values(state.get()));
  std::copy_n(values(state.get()).begin(), y.size(), y.begin());
}

}  // namespace windhover::body
