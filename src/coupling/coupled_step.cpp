#include "coupling/coupled_step.h"

#include <algorithm>
#include <cmath>

#include "base/errors.h"
#include "coupling/predictor.h"
#include "coupling/step_control.h"

namespace windhover::coupling {
namespace {

using body::LoadLayout;
using body::LoadPolynomial;

constexpr double kLeastPartOfWeight = 1e-3;

/// Calls f(first component, number of components) for force, moment and each rotor's torque.
template <class F>
void for_each_block(Eigen::Index size, F f) {
  f(LoadLayout::force, 3);
  f(LoadLayout::torque, 3);
  for (Eigen::Index j = LoadLayout::rotor; j < size; ++j) f(j, 1);
}

}  // namespace

/// One step's fixed point: counts, judges, and keeps the candidate that would be accepted.
class CoupledStep::Problem : public FixedPoint {
 public:
  Problem(CoupledStep& step, double end) : step_(step), start_(step.state_.vehicle), end_(end), scale_(least_scale()) {
    for (const auto& point : step.state_.loads) widen(scale_, point.loads);
    known_ = step.state_.loads.back().loads;
    moves_ = step.window_.responding_loads(start_);
  }

  /// Loads that move nothing, such as those on a locked axis, are taken as answered and kept from the scheme: they would
  /// be relaxed in vain.
  std::optional<VectorXd> evaluate(const VectorXd& x, double relaxation) override {
    Iteration iteration{.relaxation = relaxation};
    const bool first = result_.iterations.empty();
    const bool going_on = try_loads(first ? x : moves_.select(x, answer_.loads), iteration);
    result_.accepted = iteration.accepted;
    result_.iterations.push_back(iteration);
    if (!going_on) return {};
    return moves_.select(answer_.loads, x);
  }
  bool flow_converged() const override { return answer_.converged; }
  const VectorXd& scale() const override { return scale_; }
  double tolerance() const override { return step_.options_.tolerance; }

  /// Prediction that brings the loads that move something closest.
  VectorXd first_guess() const {
    const VectorXd ignored = VectorXd::Constant(scale_.size(), HUGE_VAL);
    return predict(step_.entry_.prediction, step_.state_.loads, end_, moves_.select(scale_, ignored));
  }

  /// Refuses a step that is solved but too large.
  void judge_size() {
    if (!result_.accepted || step_.fluid_.order() < 2) return;
    auto points = step_.state_.loads;
    points.push_back({end_, answer_.loads});
    VectorXd scale = least_scale();  // not of the iterates: the size of a step does not depend on the way to it
    for (const auto& point : points) widen(scale, point.loads);
    result_.error = load_error(points, scale, moves_);
    const double tolerance = step_.options_.step_tolerance;
    if (tolerance == 0 || !result_.error || *result_.error <= tolerance) return;
    result_.accepted = result_.iterations.back().accepted = false;
    lost(fmt::format("the loads are not linear over the step: error {:.2g}, coupling.step_tolerance {:.2g}",
                     *result_.error, tolerance));
  }

  const StepResult& result() const { return result_; }
  const VehicleState& candidate() const { return candidate_; }
  const VectorXd& loads() const { return answer_.loads; }

 private:
  /// False: stop.
  bool try_loads(const VectorXd& x, Iteration& iteration) {
    const CouplingOptions& o = step_.options_;
    const bool iterates = step_.entry_.iterates;
    const LoadPolynomial loads = over_step(x);
    try {
      candidate_ = step_.window_.advance(start_, loads, end_);
    } catch (const SolverFailure& failure) {
      return lost(failure.what());
    }
    answer_ =
        step_.fluid_.iterate([&](double part) { return state_at(part, loads); }, iterates ? o.newton_per_iteration : 0);
    if (answer_.failed) return lost(answer_.reason);
    if (!answer_.loads.allFinite()) return lost("the loads are no numbers");
    widen(scale_, answer_.loads);
    iteration.load_residual = (answer_.loads - x).cwiseQuotient(scale_).lpNorm<Eigen::Infinity>();
    if (!iterates) {
      if (!answer_.converged) return lost(answer_.reason);
      iteration.accepted = true;
      return false;
    }
    try {
      const VehicleState answered = step_.window_.advance(start_, over_step(answer_.loads), end_);
      iteration.pose_residual = step_.window_.pose_difference(start_, candidate_, answered, step_.reference_.length);
    } catch (const SolverFailure& failure) {
      return lost(failure.what());
    }
    iteration.accepted =
        answer_.converged && iteration.load_residual <= o.tolerance && iteration.pose_residual <= o.pose_tolerance;
    if (iteration.accepted) return false;
    if (static_cast<int>(result_.iterations.size()) + 1 >= o.max_iterations)
      return lost(
          fmt::format("no agreement of vehicle and air after {} coupling iterations: loads differ by {:.2g}, "
                      "poses by {:.2g}{}",
                      o.max_iterations, iteration.load_residual, iteration.pose_residual,
                      answer_.converged ? "" : ", and the flow is not solved"));
    return true;
  }

  bool lost(const std::string& reason) {
    result_.reason = reason;
    return false;
  }

  LoadPolynomial over_step(const VectorXd& x) const {
    if (step_.fluid_.order() < 2) return LoadPolynomial({{end_, x}});
    return LoadPolynomial({{start_.t, known_}, {end_, x}});
  }

  VehicleState state_at(double part, const LoadPolynomial& loads) const {
    if (part <= 0) return start_;
    if (part >= 1) return candidate_;
    return step_.window_.advance(start_, loads, start_.t + part * (end_ - start_.t));
  }

  VectorXd least_scale() const {
    const CouplingOptions& o = step_.options_;
    const body::Vehicle& vehicle = step_.window_.vehicle().vehicle();
    const double weight = vehicle.mass * vehicle.gravity_W.norm();
    const double force =
        o.force_scale_N > 0 ? o.force_scale_N : std::max(kLeastPartOfWeight * weight, step_.reference_.force);
    const double moment = o.moment_scale_Nm > 0 ? o.moment_scale_Nm : force * step_.reference_.length;
    VectorXd scale = VectorXd::Constant(step_.window_.interface_size(), moment);
    scale.segment<3>(LoadLayout::force).setConstant(force);
    return scale;
  }
  static void widen(VectorXd& scale, const VectorXd& loads) {
    for_each_block(loads.size(), [&](Eigen::Index first, int count) {
      scale.segment(first, count) = scale.segment(first, count).cwiseMax(loads.segment(first, count).norm());
    });
  }

  CoupledStep& step_;
  const VehicleState& start_;
  double end_;
  VectorXd scale_, known_;
  Window::Responses moves_;
  VehicleState candidate_;
  FluidSide::Answer answer_;
  StepResult result_;
};

CoupledStep::CoupledStep(const Window& window, FluidSide& fluid, const CouplingOptions& options,
                         const ReferenceSizes& reference)
    : window_(window),
      fluid_(fluid),
      options_(options),
      entry_(find_scheme(options)),
      scheme_(entry_.make(options, window.interface_size(), window.responding_motions())),
      reference_(reference) {}

void CoupledStep::start(const VehicleState& vehicle) {
  state_.vehicle = vehicle;
  state_.loads = {{state_.vehicle.t, fluid_.loads(state_.vehicle)}};
}

StepResult CoupledStep::advance(double end) {
  fluid_.begin([this](double) { return state_.vehicle; }, end - state_.vehicle.t);
  Problem problem(*this, end);
  scheme_->solve(problem.first_guess(), problem);
  problem.judge_size();
  if (!problem.result().accepted) {
    scheme_->reject();
    return problem.result();
  }
  scheme_->accept();
  fluid_.accept();
  state_.vehicle = problem.candidate();
  state_.loads.push_back({end, problem.loads()});
  if (state_.loads.size() > kKeptLoads) state_.loads.erase(state_.loads.begin());
  return problem.result();
}

std::vector<double> CoupledStep::pack() const {
  const VehicleState& v = state_.vehicle;
  std::vector<double> all = {v.t};
  const auto add = [&](const auto& values) {
    all.push_back(static_cast<double>(values.size()));
    all.insert(all.end(), values.begin(), values.end());
  };
  add(v.y);
  all.push_back(static_cast<double>(v.sampled.next_sample));
  add(v.sampled.state);
  add(v.sampled.held.rotor_speed);
  all.push_back(static_cast<double>(state_.loads.size()));
  for (const auto& point : state_.loads) {
    all.push_back(point.t);
    add(point.loads);
  }
  add(scheme_->state());
  return all;
}

void CoupledStep::restore(std::span<const double> all) {
  size_t at = 0;
  const auto next = [&] { return all[at++]; };
  const auto list = [&] {
    std::vector<double> values(static_cast<size_t>(next()));
    std::copy_n(all.begin() + static_cast<std::ptrdiff_t>(at), values.size(), values.begin());
    at += values.size();
    return values;
  };
  VehicleState& v = state_.vehicle;
  const VehicleState fresh = window_.start();
  v.t = next();
  v.y = list();
  if (v.y.size() != fresh.y.size())
    throw UserError("the checkpoint is of another vehicle or controller: {} states there, {} here", v.y.size(),
                    fresh.y.size());
  v.sampled.next_sample = static_cast<std::int64_t>(next());
  v.sampled.state = list();
  v.sampled.held.rotor_speed = list();
  state_.loads.resize(static_cast<size_t>(next()));
  for (auto& point : state_.loads) {
    point.t = next();
    const std::vector<double> loads = list();
    point.loads = VectorXd::Map(loads.data(), static_cast<Eigen::Index>(loads.size()));
  }
  scheme_->restore(list());
}

}  // namespace windhover::coupling
