// One pass: the loads that the vehicle moved under are never compared with those that the air answers.
#include "coupling/scheme.h"

namespace windhover::coupling {
namespace {

class SinglePass : public Scheme {
 public:
  void solve(VectorXd x, FixedPoint& fixed_point) override { fixed_point.evaluate(x, 1); }
};

}  // namespace

std::unique_ptr<Scheme> make_single_pass(const CouplingOptions&, int, int) { return std::make_unique<SinglePass>(); }

}  // namespace windhover::coupling
