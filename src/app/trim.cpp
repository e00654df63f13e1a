#include "app/trim.h"

#include <cmath>
#include <numbers>

#include "app/held_flight.h"
#include "app/progress.h"
#include "app/run.h"
#include "app/simulation.h"
#include "app/trim_results.h"
#include "base/errors.h"

namespace windhover::app {
namespace {

using coupling::Hold;
using coupling::VectorXd;

/// Far from balance, means need no more precision than this part of what is left.
constexpr double kEnough = 0.25;

/// Of `count` windows that end before `end`.
coupling::MeanLoads mean_of(const std::vector<coupling::MeanLoads>& windows, size_t end, size_t count) {
  coupling::MeanLoads mean = windows[end - count];
  for (size_t i = end - count + 1; i < end; ++i) {
    mean.loads += windows[i].loads;
    for (size_t j = 0; j < mean.rotor_wrench.size(); ++j) mean.rotor_wrench[j] += windows[i].rotor_wrench[j];
  }
  mean.loads /= static_cast<double>(count);
  for (auto& wrench : mean.rotor_wrench) wrench /= static_cast<double>(count);
  return mean;
}

/// One try after the other, each a flow that goes on from the last.
class Trim : public coupling::BalanceProblem {
 public:
  Trim(const Case& c, Run& run, HeldFlight& held, TrimResults& results)
      : case_(c), run_(run), held_(held), results_(results) {}

  std::optional<VectorXd> evaluate(const VectorXd& u) override {
    const double begin = MPI_Wtime();
    hold_ = held_.equilibrium().hold(u);
    try_ = {.number = try_.number + 1};
    windows_.clear();
    if (try_.number > 1) {
      const double ramp = case_.trim.ramp_windows * window_s();
      held_.move_to(hold_, ramp);
      if (!advance(run_.time_s() + ramp, {})) return {};
    }
    while (!try_.settled && try_.windows < case_.trim.max_windows)
      if (!average()) return {};
    try_.left = held_.equilibrium().unbalanced(hold_, mean_.loads);
    try_.wall_s = MPI_Wtime() - begin;
    results_.add(run_, held_.equilibrium(), hold_, try_);
    run_.write_checkpoint();
    return held_.equilibrium().residual(hold_, mean_.loads);
  }

  double uncertainty() const override { return try_.change; }
  coupling::MatrixXd model_jacobian() override { return held_.equilibrium().model_jacobian(hold_, mean_); }

  const Try& latest() const { return try_; }
  const Hold& hold() const { return hold_; }
  int signal() const { return signal_; }

 private:
  double window_s() const {
    if (case_.trim.window_s) return *case_.trim.window_s;
    const double turns = hold_.rotor_speed.cwiseAbs().mean() / (2 * std::numbers::pi);
    return case_.trim.window_revolutions.value_or(1) / turns;
  }

  /// Steps of equal length, as near to those of a run as may be, until `end`: a window always samples the same angles of
  /// the rotors. `each` sees the length of each step done. False: interrupted.
  bool advance(double end, const std::function<void(double dt)>& each) {
    const double begin = run_.time_s(), nominal = step_seconds(case_);
    const double dt = (end - begin) / std::max(1.0, std::round((end - begin) / nominal));
    Progress progress(begin, end, run_.comm());
    for (double before = begin; before < end * (1 - 1e-12); before = run_.time_s()) {
      if ((signal_ = agreed_signal(run_.comm()))) return false;
      run_.step(dt, end);
      if (each) each(run_.time_s() - before);
      const fluid::StepReport& report = run_.report();
      progress.report({static_cast<int>(run_.solver().state().step), run_.time_s(), report.newton(), report.krylov()});
    }
    return true;
  }

  /// One more window. The means are those over the last third of the try's windows, and their change is that from the
  /// third before: the first are still under the try before, and a wake is never the same twice. False: interrupted.
  bool average() {
    const double length = window_s();
    coupling::MeanLoads last = held_.air(), sum = last;
    sum.loads.setZero();
    for (auto& wrench : sum.rotor_wrench) wrench.setZero();
    const bool whole = advance(run_.time_s() + length, [&](double dt) {
      const coupling::MeanLoads now = held_.air();
      sum.loads += dt / (2 * length) * (last.loads + now.loads);
      for (size_t j = 0; j < sum.rotor_wrench.size(); ++j)
        sum.rotor_wrench[j] += dt / (2 * length) * (last.rotor_wrench[j] + now.rotor_wrench[j]);
      last = now;
    });
    if (!whole) return false;
    windows_.push_back(sum);
    const coupling::Equilibrium& equilibrium = held_.equilibrium();
    const size_t all = windows_.size(), third = std::max<size_t>(1, all / 3);
    mean_ = mean_of(windows_, all, third);
    const VectorXd left = equilibrium.residual(hold_, mean_.loads);
    try_.residual = left.lpNorm<Eigen::Infinity>();
    try_.windows = static_cast<int>(all);
    if (all > 1) {
      const VectorXd before = equilibrium.residual(hold_, mean_of(windows_, all - third, third).loads);
      try_.change = (left - before).lpNorm<Eigen::Infinity>();
      try_.settled = try_.change <= std::max(case_.trim.mean_tolerance, kEnough * try_.residual);
    }
    results_.tell(run_, try_);
    return true;
  }

  const Case& case_;
  Run& run_;
  HeldFlight& held_;
  TrimResults& results_;
  Hold hold_;
  std::vector<coupling::MeanLoads> windows_;  ///< means of each of the try's
  coupling::MeanLoads mean_;
  Try try_;
  int signal_ = 0;
};

void require_window(const Case& c) {
  const coupling::TrimOptions& o = c.trim;
  bool turns = false;
  for (const auto& rotor : c.body.vehicle.rotor) turns = turns || rotor.speed_rad_s != 0;
  if (o.window_s && o.window_revolutions)
    throw UserError("trim.window_s: at most one of window_s and window_revolutions");
  if (!o.window_s && !turns)
    throw UserError("trim.window_s: is needed, since no rotor turns whose revolution could be the window");
}

}  // namespace

void validate_trim(const Case& c) {
  try {
    if (!is_dynamic(c))
      throw UserError("body.kind = \"{}\": only a body of kind \"dynamic\" can be trimmed", c.body.kind);
    const coupling::Window window(vehicle_model(c));
    const coupling::Equilibrium equilibrium(window, c.trim, c.fluid.length_m);
    require_window(c);
    if (const ZoneOptions* zone = zone_turned_by_time(c))
      throw UserError("zone: \"{}\" turns by itself, and a trim is for rotors of the body: give it a [[body.rotor]]",
                      zone->name);
  } catch (const UserError& error) {
    throw UserError("{}: {}", c.file.string(), error.what());
  }
}

int run_trim(const Case& c, const std::string& out) {
  Run run(c, out.empty() ? c.output.directory + "_trim" : out);
  HeldFlight held(c, run.solver(), run.zones());
  held.start(run.begin(false));
  run.open(held);
  const coupling::Equilibrium& equilibrium = held.equilibrium();
  TrimResults results(c, run, equilibrium);
  Trim trim(c, run, held, results);
  coupling::BalanceResult balance;
  try {
    balance = solve_balance(trim, equilibrium.scaled_unknowns(held.hold()), equilibrium.solver_options());
  } catch (const SolverFailure& failure) {
    balance.reason = failure.what();
  }
  if (balance.converged && !trim.latest().settled) {
    balance.converged = false;
    balance.reason = fmt::format("in balance, but the means still change by {:.2g} after {} windows",
                                 trim.latest().change, trim.latest().windows);
  }
  run.finish(!trim.signal());
  results.finish(run, held, balance);
  if (trim.signal()) return 128 + trim.signal();
  if (!balance.converged)
    throw SolverFailure("trim: {}; the tries are in {}", balance.reason, (run.directory() / "trim.csv").string());
  return 0;
}

}  // namespace windhover::app
