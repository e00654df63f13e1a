#include "app/run.h"

#include <algorithm>
#include <cmath>

#include "app/flight.h"
#include "app/flow_fields.h"
#include "app/flow_setup.h"
#include "app/vehicle.h"
#include "app/wind.h"
#include "base/collective.h"
#include "base/errors.h"
#include "io/file.h"
#include "io/results.h"

namespace windhover::app {

Run::Run(const Case& c, const std::filesystem::path& directory)
    : case_(c),
      directory_(directory),
      scales_(c.fluid),
      started_(MPI_Wtime()),
      zoned_(read_zones(c, PETSC_COMM_WORLD)),
      mesh_(zoned_.mesh),
      euler_(mesh_, flow_model(c), std::move(zoned_.interfaces)),
      solver_(euler_, flow_options(c)),
      zones_(c, mesh_),
      checkpoint_(c, mesh_),
      summary_(c, mesh_),
      audit_(c),
      control_(is_dynamic(c) ? c.coupling.step_tolerance : 0) {}

std::vector<double> Run::begin(bool restart) {
  io::prepare_results(directory_, restart, mesh_.comm);
  fluid::FlowState& state = solver_.state();
  if (restart) {
    Memory memory = checkpoint_.read(directory_, state);
    from_ = state.step;
    averages_ = std::move(memory.averages);
    if (!memory.step.empty()) control_.restore(memory.step);
    return memory.vehicle;
  }
  if (!case_.time.start_from.empty()) {
    const Memory memory = checkpoint_.read(case_.time.start_from, state);
    state.step = 0;
    state.time = 0;
    const Vec3 jump = wind_jump(case_) / scales_.velocity;
    fluid::add_velocity(jump, state.q);
    fluid::add_velocity(jump, state.previous);
    if (state.step_before > 0) fluid::add_velocity(jump, state.earlier);
    if (!memory.step.empty()) control_.restore(memory.step);  // no first step: the flow is under way
    return memory.vehicle;
  }
  fluid::set_initial(euler_, initial_frames(case_, zones_), initial_state(case_), state.q);
  return {};
}

void Run::open(Mover& mover) {
  mover_ = &mover;
  history_.emplace(case_, directory_, mesh_.comm, from_);
  rotors_.emplace(case_, mesh_, directory_, from_);
  if (from_) rotors_->restore(averages_);
  fields_.emplace(directory_, mesh_.comm, from_);
  on_root(mesh_.comm, [this] { io::write_atomically(directory_ / "case.toml", effective_case(case_)); });
  summary_.start(solver_, MPI_Wtime() - started_);
  if (from_) return;
  append_history({});
  write_fields();
}

/// The row of the current state, and what else is written once a step.
Loads Run::append_history(StepRecord record) {
  const fluid::Frames now = mover_->frames();
  const auto fluxes = euler_.patch_fluxes(solver_.state().q, now);
  record.rotors = rotors_->step(solver_, fluxes, now);
  audit_.add(solver_, fluxes);
  thrust_N_.reset();
  for (const RotorLoads& rotor : record.rotors) thrust_N_ = thrust_N_.value_or(0) + rotor.thrust_N;
  return history_->append(solver_, mover_->body(), fluxes, record);
}

void Run::step(double dt_s, double end_s) {
  const fluid::FlowState& state = solver_.state();
  const double nominal = dt_s / scales_.time(), end = end_s / scales_.time(), begin = MPI_Wtime();
  const double first_ratio = case_.time.first_step_ratio, event = std::min(end, mover_->next_event());
  double dt = control_.propose(nominal, first_ratio, state.time, event);
  const double smallest = first_ratio * nominal * std::pow(0.5, case_.solver.max_halvings);
  while (!(last_ = mover_->advance(dt)).flow.accepted) {
    summary_.rejected();
    const double smaller = control_.refused(dt, last_.error);
    if (smaller < smallest) give_up(dt);
    dt = smaller;
  }
  control_.accepted(dt, last_.error, nominal);
  const double solved = MPI_Wtime();
  saved_ = false;
  const Loads loads = append_history({last_.flow, solved - begin, {}, last_.iterations});
  summary_.step(last_.flow, last_.iterations, state, loads, solved - begin);
  if (case_.output.fields_interval > 0 && state.step % case_.output.fields_interval == 0) write_fields();
  if (state.step % case_.output.checkpoint_interval == 0) write_checkpoint();
  summary_.output(MPI_Wtime() - solved);
}

std::string Run::aircraft() const {
  std::string text;
  if (is_dynamic(case_)) {
    const Attitude a = attitude(mover_->body().R);
    text = fmt::format("roll {:.2f}  pitch {:.2f}  yaw {:.2f} deg", a.roll_deg, a.pitch_deg, a.yaw_deg);
  }
  if (thrust_N_) text += fmt::format("{}thrust {:.4g} N", text.empty() ? "" : "  ", *thrust_N_);
  return text;
}

void Run::give_up(double dt) {
  const fluid::FlowState& state = solver_.state();
  if (!saved_) write_checkpoint();
  throw SolverFailure("step {} after {:.6g} s failed, the last try with {:.3g} s: {}; the last accepted state is in {}",
                      state.step + 1, state.time * scales_.time(), dt * scales_.time(), last_.flow.reason,
                      (directory_ / "checkpoint").string());
}

void Run::write_checkpoint() {
  checkpoint_.write(directory_, solver_.state(), mover_->frames(),
                    {rotors_->state(), mover_->state(), control_.state()});
  solver_.renew();  // a run that is restarted from here must do the same
  saved_ = true;
}

void Run::write_fields() {
  if (fields_step_ == solver_.state().step) return;
  fields_step_ = solver_.state().step;
  rotors_->write();
  fields_->write(fields_step_, time_s(), flow_fields(case_, solver_, mover_->frames()));
}

void Run::finish(bool fields) {
  if (!saved_) write_checkpoint();
  if (fields) write_fields();
  summary_.write(directory_, solver_, rotors_->summary(), audit_.result(solver_), MPI_Wtime() - started_);
}

}  // namespace windhover::app
