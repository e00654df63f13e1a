#include "app/simulation.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "app/flight.h"
#include "app/flow_checkpoint.h"
#include "app/flow_fields.h"
#include "app/flow_setup.h"
#include "app/history.h"
#include "app/progress.h"
#include "app/rotor_output.h"
#include "app/summary.h"
#include "app/zone_tree.h"
#include "base/collective.h"
#include "base/errors.h"
#include "base/interrupt.h"
#include "io/file.h"
#include "io/results.h"

namespace windhover::app {
namespace {

namespace fs = std::filesystem;

/// The signal any rank has received, or 0. Collective.
int agreed_signal(MPI_Comm comm) {
  int signal = interrupt_signal();
  MPI_Allreduce(MPI_IN_PLACE, &signal, 1, MPI_INT, MPI_MAX, comm);
  return signal;
}

/// The time loop of one run and its outputs.
class Simulation {
 public:
  Simulation(const Case& c, const RunOptions& options)
      : case_(c),
        directory_(options.out.empty() ? c.output.directory : options.out),
        scales_(c.fluid),
        started_(MPI_Wtime()),
        zoned_(read_zones(c, PETSC_COMM_WORLD)),
        mesh_(zoned_.mesh),
        euler_(mesh_, flow_model(c), std::move(zoned_.interfaces)),
        solver_(euler_, flow_options(c)),
        zones_(c, mesh_),
        checkpoint_(c, mesh_),
        summary_(c, mesh_),
        nominal_step_(step_seconds(c) / scales_.time()),
        last_step_(options.steps ? *options.steps : step_count(c)),
        end_time_(options.steps || c.time.steps ? HUGE_VAL : end_seconds(c) / scales_.time()) {
    start(options.restart);
  }

  int run() {
    const double end = end_time_ == HUGE_VAL ? last_step_ * nominal_step_ : end_time_;
    Progress progress(solver_.state().time * scales_.time(), end * scales_.time(), mesh_.comm);
    int signal = 0;
    while (!finished() && !(signal = agreed_signal(mesh_.comm))) {
      step();
      progress.report({static_cast<int>(solver_.state().step), solver_.state().time * scales_.time(),
                       last_report_.newton(), last_report_.krylov()});
    }
    if (!saved_) write_checkpoint();
    if (!signal) write_fields();
    summary_.write(directory_, solver_, rotors_->summary(), MPI_Wtime() - started_);
    return signal ? 128 + signal : 0;
  }

 private:
  /// Frames at the current state.
  fluid::Frames frames() const { return flight_ ? flight_->frames() : zones_.frames(solver_.state().time); }
  mesh::FrameState body() const { return flight_ ? flight_->body() : zones_.body(solver_.state().time); }

  bool finished() const {
    const fluid::FlowState& s = solver_.state();
    return end_time_ == HUGE_VAL ? s.step >= last_step_ : s.time >= end_time_ * (1 - 1e-12);
  }

  void start(bool restart) {
    io::prepare_results(directory_, restart, mesh_.comm);
    std::optional<std::int64_t> from;
    Memory memory;
    if (restart) {
      memory = checkpoint_.read(directory_, solver_.state());
      from = solver_.state().step;
    } else {
      fluid::set_initial(euler_, initial_frames(case_, zones_), initial_state(case_), solver_.state().q);
    }
    if (is_dynamic(case_)) flight_.emplace(case_, solver_, zones_);
    if (flight_ && restart) flight_->restore(memory.vehicle);
    if (flight_ && !restart) flight_->start();
    if (flight_) flight_->open(directory_, from);
    history_.emplace(case_, directory_, mesh_.comm, from);
    rotors_.emplace(case_, mesh_, directory_, from);
    if (restart) rotors_->restore(memory.averages);
    fields_.emplace(directory_, mesh_.comm, from);
    on_root(mesh_.comm, [this] { io::write_atomically(directory_ / "case.toml", effective_case(case_)); });
    summary_.start(solver_, MPI_Wtime() - started_);
    if (restart) return;
    append_history({});
    write_fields();
  }

  /// The row of the current state, and what else is written once a step.
  Loads append_history(StepRecord record) {
    const fluid::FlowState& state = solver_.state();
    const fluid::Frames now = frames();
    const auto fluxes = euler_.patch_fluxes(state.q, now);
    record.rotors = rotors_->step(solver_, fluxes, now);
    return history_->append(solver_, body(), fluxes, record);
  }

  /// One accepted step: the nominal one, or as much less as Newton's method needs.
  void step() {
    const fluid::FlowState& state = solver_.state();
    const double begin = MPI_Wtime();
    // after a reduced step the next ones grow back; depends on the state alone, so a restart does the same
    double dt = state.last_step > 0 ? std::min(nominal_step_, 2 * state.last_step)
                                    : case_.time.first_step_ratio * nominal_step_;
    if (dt > 0.999 * nominal_step_) dt = nominal_step_;
    if (end_time_ - state.time < dt * (1 - 1e-9)) dt = end_time_ - state.time;
    const double smallest = case_.time.first_step_ratio * nominal_step_ * std::pow(0.5, case_.solver.max_halvings);
    for (;; dt /= 2) {
      try_step(dt);
      if (last_report_.accepted) break;
      summary_.rejected();
      if (dt / 2 < smallest) give_up(dt);
    }
    const double solved = MPI_Wtime();
    saved_ = false;
    const Loads loads = append_history({last_report_, solved - begin, {}, coupling_iterations_});
    summary_.step(last_report_, solver_.state(), loads, solved - begin);
    if (case_.output.fields_interval > 0 && state.step % case_.output.fields_interval == 0) write_fields();
    if (state.step % case_.output.checkpoint_interval == 0) write_checkpoint();
    summary_.output(MPI_Wtime() - solved);
  }

  void try_step(double dt) {
    if (!flight_) {
      last_report_ = solver_.advance([this](double t) { return zones_.frames(t); }, dt);
      return;
    }
    Flight::Result result = flight_->advance(dt);
    last_report_ = std::move(result.flow);
    coupling_iterations_ = result.iterations;
  }

  [[noreturn]] void give_up(double dt) {
    const fluid::FlowState& state = solver_.state();
    if (!saved_) write_checkpoint();
    throw SolverFailure("step {} after {:.6g} s failed, the last try with {:.3g} s: {}; the last accepted state is in {}",
                        state.step + 1, state.time * scales_.time(), dt * scales_.time(), last_report_.reason, (directory_ / "checkpoint").string());
  }

  void write_checkpoint() {
    checkpoint_.write(directory_, solver_.state(), frames(), {rotors_->state(), flight_ ? flight_->state() : std::vector<double>()});
    saved_ = true;
  }

  void write_fields() {
    if (fields_step_ == solver_.state().step) return;
    fields_step_ = solver_.state().step;
    const double time = solver_.state().time;
    rotors_->write();
    fields_->write(fields_step_, time * scales_.time(), flow_fields(case_, solver_, frames()));
  }

  const Case& case_;
  fs::path directory_;
  Scales scales_;
  double started_;
  ZonedMesh zoned_;
  const mesh::Mesh& mesh_;
  fluid::EulerOperator euler_;
  fluid::FlowSolver solver_;
  ZoneTree zones_;
  std::optional<Flight> flight_;  ///< when the air moves the body
  FlowCheckpoint checkpoint_;
  Summary summary_;
  double nominal_step_;
  long last_step_;
  double end_time_;  ///< nondimensional; infinite when the number of steps decides
  std::optional<History> history_;
  std::optional<RotorOutput> rotors_;
  std::optional<io::FieldWriter> fields_;
  fluid::StepReport last_report_;
  int coupling_iterations_ = 0;
  bool saved_ = false;
  long fields_step_ = -1;
};

}  // namespace

int run_simulation(const Case& c, const RunOptions& options) { return Simulation(c, options).run(); }

}  // namespace windhover::app
