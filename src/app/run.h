// Flow and results of a run; what moves the zones, and how far it goes, is the caller's business.
#pragma once
#include <optional>

#include "app/flow_checkpoint.h"
#include "app/history.h"
#include "app/momentum_audit.h"
#include "app/mover.h"
#include "app/rotor_output.h"
#include "app/summary.h"
#include "coupling/step_control.h"
#include "io/fields.h"

namespace windhover::app {

class Run {
 public:
  /// Reads the mesh. Collective, as all that follows.
  Run(const Case& c, const std::filesystem::path& directory);

  fluid::FlowSolver& solver() { return solver_; }
  const ZoneTree& zones() const { return zones_; }
  MPI_Comm comm() const { return mesh_.comm; }
  const std::filesystem::path& directory() const { return directory_; }
  /// Attitude of a dynamic body and thrust of the rotors at the current state; empty without either.
  std::string aircraft() const;
  double time_s() const { return solver_.state().time * scales_.time(); }

  /// Sets the flow: from the folder's newest checkpoint (restart), from that of time.start_from, or as [fluid.initial]
  /// says. Returns the vehicle that the checkpoint holds, if any.
  std::vector<double> begin(bool restart);
  /// Starts the tables, or continues them after a restart.
  void open(Mover& mover);
  /// The step to continue tables from after a restart.
  std::optional<std::int64_t> from() const { return from_; }

  /// One accepted step: of dt (s), or as much less as Newton's method and coupling.step_tolerance need, and never past
  /// `end` (s) or an event. SolverFailure, with the last accepted state saved, when it cannot.
  void step(double dt_s, double end_s);
  /// What the latest step took.
  const fluid::StepReport& report() const { return last_.flow; }
  int coupling_iterations() const { return last_.iterations; }

  void write_checkpoint();
  /// The end: a checkpoint, unless there is one of this step, summary.json, and with `fields` the fields.
  void finish(bool fields);

 private:
  Loads append_history(StepRecord record);
  [[noreturn]] void give_up(double dt);
  void write_fields();

  const Case& case_;
  std::filesystem::path directory_;
  Scales scales_;
  double started_;
  ZonedMesh zoned_;
  const mesh::Mesh& mesh_;
  fluid::EulerOperator euler_;
  fluid::FlowSolver solver_;
  ZoneTree zones_;
  FlowCheckpoint checkpoint_;
  Summary summary_;
  MomentumAudit audit_;
  Mover* mover_ = nullptr;
  std::optional<std::int64_t> from_;
  std::vector<double> averages_;
  std::optional<History> history_;
  std::optional<RotorOutput> rotors_;
  std::optional<io::FieldWriter> fields_;
  coupling::StepControl control_;
  Mover::Result last_;
  std::optional<double> thrust_N_;  ///< of all rotors, each along its axis; none without rotors
  bool saved_ = false;
  long fields_step_ = -1;
};

}  // namespace windhover::app
