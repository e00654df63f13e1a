// Constant relaxation: x + omega (G(x) - x).
#include "coupling/scheme.h"

namespace windhover::coupling {
namespace {

class Constant : public Scheme {
 public:
  explicit Constant(double relaxation) : relaxation_(relaxation) {}

  void solve(VectorXd x, FixedPoint& fixed_point) override {
    while (const auto g = fixed_point.evaluate(x, relaxation_)) x += relaxation_ * (*g - x);
  }

 private:
  double relaxation_;
};

}  // namespace

std::unique_ptr<Scheme> make_constant(const CouplingOptions& options, int, int) {
  return std::make_unique<Constant>(options.relaxation);
}

}  // namespace windhover::coupling
