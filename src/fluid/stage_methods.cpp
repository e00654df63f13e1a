#include "fluid/stage_methods.h"

namespace windhover::fluid {
namespace {

std::unique_ptr<StageSolver> make_newton(EulerOperator& euler, const NewtonOptions& newton, const DualTimeOptions&) {
  return std::make_unique<NewtonKrylov>(euler, newton);
}

std::unique_ptr<StageSolver> make_dual_time(EulerOperator& euler, const NewtonOptions&,
                                            const DualTimeOptions& dual_time) {
  return std::make_unique<DualTime>(euler, dual_time);
}

}  // namespace

const StageMethod kStageMethods[2] = {{"newton_krylov", make_newton}, {"dual_time", make_dual_time}};

}  // namespace windhover::fluid
