// Relaxation by Aitken's Δ² (Irons & Tuck 1969; Küttler & Wall, Comput. Mech. 43, 2008): the factor that would have
// brought the last two residuals to zero on the line between them.
#include "coupling/first_factor.h"
#include "coupling/scheme.h"

namespace windhover::coupling {
namespace {

class Aitken : public Scheme {
 public:
  explicit Aitken(double relaxation) : first_(relaxation) {}

  void accept() override { first_.keep(); }
  std::vector<double> state() const override { return first_.state(); }
  void restore(std::span<const double> state) override { first_.restore(state); }

  void solve(VectorXd x, FixedPoint& fixed_point) override {
    double relaxation = first_.begin();
    VectorXd last;
    while (const auto g = fixed_point.evaluate(x, relaxation)) {
      const VectorXd residual = (*g - x).cwiseQuotient(fixed_point.scale());
      if (last.size() > 0) relaxation = aitken_factor(last, residual, relaxation);
      first_.observe(residual);
      last = residual;
      x += relaxation * (*g - x);
    }
  }

 private:
  FirstFactor first_;
};

}  // namespace

std::unique_ptr<Scheme> make_aitken(const CouplingOptions& options, int, int) {
  return std::make_unique<Aitken>(options.relaxation);
}

}  // namespace windhover::coupling
