#include "app/summary.h"

#include <algorithm>

#include "base/memory.h"
#include "base/version.h"
#include "io/results.h"

namespace windhover::app {
namespace {

double total_mass(const fluid::FlowSolver& solver) { return solver.euler().total(solver.state().q)[0]; }

/// GB over all ranks.
double sum_GB(double bytes, MPI_Comm comm) {
  MPI_Allreduce(MPI_IN_PLACE, &bytes, 1, MPI_DOUBLE, MPI_SUM, comm);
  return 1e-9 * bytes;
}

}  // namespace

void Summary::start(const fluid::FlowSolver& solver, double setup_s) {
  first_step_ = solver.state().step;
  mass_ = total_mass(solver);
  setup_s_ = setup_s;
}

void Summary::step(const fluid::StepReport& report, int coupling, const fluid::FlowState& state, const Loads& loads,
                   double seconds) {
  if (memory_ == 0) memory_ = resident_bytes();
  solve_s_ += seconds;
  newton_ += report.newton();
  krylov_ += report.krylov();
  coupling_ += coupling;
  if (state.time * Scales(case_.fluid).time() < case_.output.average_from_s) return;
  ++averaged_;
  sum_.force_N += loads.force_N;
  sum_.moment_Nm += loads.moment_Nm;
}

void Summary::write(const std::filesystem::path& directory, const fluid::FlowSolver& solver, const nlohmann::ordered_json& rotors,
                    const nlohmann::ordered_json& momentum, double wall_s) const {
  int ranks = 1;
  MPI_Comm_size(mesh_.comm, &ranks);
  const long steps = solver.state().step - first_step_;
  const double per_step = 1.0 / std::max(1L, steps), per_average = 1.0 / std::max(1L, averaged_);
  nlohmann::ordered_json j;
  j["case"] = case_.name;
  j["version"] = version;
  j["revision"] = revision;
  j["steps"] = steps;
  j["rejected_steps"] = rejected_;
  j["last_step"] = solver.state().step;
  j["time_s"] = solver.state().time * Scales(case_.fluid).time();
  j["cells"] = mesh_.n_global;
  j["ranks"] = ranks;
  j["wall_s"] = {{"total", wall_s}, {"setup", setup_s_}, {"fluid", solve_s_}, {"output", output_s_}};
  j["memory_GB"] = {{"first_step", sum_GB(memory_, mesh_.comm)},
                    {"end", sum_GB(resident_bytes(), mesh_.comm)},
                    {"peak", sum_GB(peak_resident_bytes(), mesh_.comm)}};
  j["seconds_per_step"] = solve_s_ * per_step;
  j["newton_per_step"] = double(newton_) * per_step;
  j["krylov_per_step"] = double(krylov_) * per_step;
  if (coupling_ > 0) j["coupling_iterations_per_step"] = double(coupling_) * per_step;
  j["averages"] = {{"from_s", case_.output.average_from_s},
                   {"steps", averaged_},
                   {"force_N", io::list(per_average * sum_.force_N)},
                   {"moment_Nm", io::list(per_average * sum_.moment_Nm)}};
  if (!rotors.empty()) j["rotors"] = rotors;
  j["mass_drift"] = total_mass(solver) / mass_ - 1;
  j["momentum"] = momentum;
  io::write_json(directory / "summary.json", j, mesh_.comm);
}

}  // namespace windhover::app
