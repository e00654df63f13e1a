// Anderson acceleration by KINSOL's fixed-point iteration (Walker & Ni, SIAM J. Numer. Anal. 49, 2011). KINSOL proposes
// the loads; each call of its system function is one coupling iteration, and the judgement of when to stop is not
// KINSOL's: the function then returns an error, which ends its loop.
#include <algorithm>

#include "base/petsc.h"
#include "coupling/first_factor.h"
#include "coupling/kinsol.h"
#include "coupling/scheme.h"

namespace windhover::coupling {
namespace {

/// What the system function needs; vectors in KINSOL are scaled.
struct Problem {
  FixedPoint& fixed_point;
  FirstFactor& first;
  VectorXd scale;
  double relaxation;
  bool stopped = false;
  CallbackGuard guard = {};
};

int system_function(N_Vector x, N_Vector g, void* data) {
  constexpr int kStop = -1;
  Problem& problem = *static_cast<Problem*>(data);
  const int failed = problem.guard.run([&] {
    const VectorXd proposed = values(x).cwiseProduct(problem.scale);
    const auto answer = problem.fixed_point.evaluate(proposed, problem.relaxation);
    problem.stopped = !answer;
    if (!answer) return;
    const VectorXd residual = (*answer - proposed).cwiseQuotient(problem.scale);
    problem.first.observe(residual);
    values(g) = values(x) + problem.relaxation * residual;  // KINSOL's own damping leaves out the first iteration
  });
  return failed || problem.stopped ? kStop : 0;
}

void no_message(int, const char*, const char*, char*, void*) {}

class Anderson : public Scheme {
 public:
  Anderson(const CouplingOptions& options, int size, int motions)
      : first_(options.relaxation),
        context_(sundials::make_context()),
        x_(N_VNew_Serial(size, context_.get())),
        one_(N_VNew_Serial(size, context_.get())),
        kinsol_(KINCreate(context_.get())) {
    N_VConst(1.0, one_.get());
    check(KINSetNumMaxIters(kinsol_.get(), options.max_iterations));
    // residuals vary in as many directions as the vehicle has motions; further columns would be linearly dependent
    check(KINSetMAA(kinsol_.get(), std::clamp(motions, 1, options.columns)));
    check(KINInit(kinsol_.get(), system_function, x_.get()));
    check(KINSetErrHandlerFn(kinsol_.get(), no_message, nullptr));
    check(KINSetFuncNormTol(kinsol_.get(), 1e-300));  // the fixed point judges
  }

  void accept() override { first_.keep(); }
  std::vector<double> state() const override { return first_.state(); }
  void restore(std::span<const double> state) override { first_.restore(state); }

  void solve(VectorXd x, FixedPoint& fixed_point) override {
    Problem problem{fixed_point, first_, fixed_point.scale(), first_.begin()};
    check(KINSetUserData(kinsol_.get(), &problem));
    values(x_.get()) = x.cwiseQuotient(problem.scale);
    while (!problem.stopped) {  // KINSOL ends by itself only where x stands still while the flow is not yet solved
      KINSol(kinsol_.get(), x_.get(), KIN_FP, one_.get(), one_.get());
      problem.guard.rethrow();
    }
  }

 private:
  FirstFactor first_;
  sundials::Context context_;
  sundials::Vector x_, one_;
  Kinsol kinsol_;
};

}  // namespace

std::unique_ptr<Scheme> make_anderson(const CouplingOptions& options, int size, int motions) {
  return std::make_unique<Anderson>(options, size, motions);
}

}  // namespace windhover::coupling
