// Relaxation by Aitken's Δ² (Irons & Tuck 1969; Küttler & Wall, Comput. Mech. 43, 2008): the factor that would have
// brought the last two residuals to zero on the line between them.
#include "coupling/scheme.h"

namespace windhover::coupling {
namespace {

class Aitken : public Scheme {
 public:
  explicit Aitken(double relaxation) : first_(relaxation) {}

  void solve(VectorXd x, FixedPoint& fixed_point) override {
    double relaxation = first_;
    VectorXd last;
    while (const auto g = fixed_point.evaluate(x, relaxation)) {
      const VectorXd residual = (*g - x).cwiseQuotient(fixed_point.scale());
      if (last.size() > 0) {
        const VectorXd change = residual - last;
        if (change.squaredNorm() > 0) relaxation *= -last.dot(change) / change.squaredNorm();
      }
      last = residual;
      x += relaxation * (*g - x);
    }
  }

 private:
  double first_;
};

}  // namespace

std::unique_ptr<Scheme> make_aitken(const CouplingOptions& options, int, int) {
  return std::make_unique<Aitken>(options.relaxation);
}

}  // namespace windhover::coupling
