#include "app/simulation.h"

#include <cmath>

#include "app/flight.h"
#include "app/progress.h"
#include "app/run.h"
#include "base/interrupt.h"

namespace windhover::app {
namespace {

/// What moves the zones, ready to go on from the flow that has begun.
std::unique_ptr<Mover> make_mover(const Case& c, Run& run, bool restart, const std::vector<double>& vehicle) {
  if (!is_dynamic(c)) return std::make_unique<PrescribedMotion>(run.solver(), run.zones());
  auto flight = std::make_unique<Flight>(c, run.solver(), run.zones());
  if (restart)
    flight->restore(vehicle);
  else if (!vehicle.empty())
    flight->start_from(vehicle);
  else
    flight->start();
  flight->open(run.directory(), run.from());
  return flight;
}

}  // namespace

int agreed_signal(MPI_Comm comm) {
  int signal = interrupt_signal();
  MPI_Allreduce(MPI_IN_PLACE, &signal, 1, MPI_INT, MPI_MAX, comm);
  return signal;
}

int run_simulation(const Case& c, const RunOptions& options) {
  Run run(c, options.out.empty() ? c.output.directory : options.out);
  const std::vector<double> vehicle = run.begin(options.restart);
  const auto mover = make_mover(c, run, options.restart, vehicle);
  run.open(*mover);

  const double dt = step_seconds(c);
  const bool by_steps = options.steps || c.time.steps;
  const long last_step = options.steps ? *options.steps : step_count(c);
  const double end = by_steps ? HUGE_VAL : end_seconds(c);
  const fluid::FlowState& state = run.solver().state();
  const auto finished = [&] { return by_steps ? state.step >= last_step : run.time_s() >= end * (1 - 1e-12); };
  int signal = 0;
  {
    Progress progress(run.time_s(), by_steps ? last_step * dt : end, run.comm());
    while (!finished() && !(signal = agreed_signal(run.comm()))) {
      run.step(dt, end);
      progress.report({static_cast<int>(state.step), run.time_s(), run.report().newton(), run.report().krylov(),
                       run.coupling_iterations(), run.aircraft()});
    }
  }
  run.finish(!signal);
  return signal ? 128 + signal : 0;
}

}  // namespace windhover::app
