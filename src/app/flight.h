// A run whose body moves under the air's loads: the flow solver and the vehicle, step by step together.
#pragma once
#include "app/vehicle.h"
#include "app/zone_tree.h"
#include "coupling/coupled_step.h"
#include "fluid/flow_solver.h"
#include "io/csv.h"

namespace windhover::app {

class Flight : private coupling::FluidSide {
 public:
  Flight(const Case& c, fluid::FlowSolver& solver, const ZoneTree& zones);

  /// Frames at the current state, nondimensional.
  mesh::FrameState body() const { return body(step_.state().vehicle); }
  fluid::Frames frames() const { return frames(step_.state().vehicle); }

  /// The loads of the initial flow; once it is set. Collective, as all that follows.
  void start() { step_.start(); }
  /// Opens coupling.csv; `last_step`: continue it from there.
  void open(const std::filesystem::path& directory, std::optional<std::int64_t> last_step);

  struct Result {
    fluid::StepReport flow;  ///< `accepted` is that of flow and vehicle together
    int iterations = 0;      ///< of the coupling
  };
  /// One step of this size (nondimensional), or none: then nothing has changed, and the reason is told.
  Result advance(double dt);

  /// All that a restart needs besides the flow.
  std::vector<double> state() const { return step_.pack(); }
  void restore(std::span<const double> state) { step_.restore(state); }

 private:
  coupling::VectorXd loads(const coupling::VehicleState& vehicle) override;
  void begin(const coupling::Trajectory& motion, double dt) override;
  Answer iterate(const coupling::Trajectory& motion, int newton) override;
  void accept() override { solver_.accept(); }
  int order() const override { return solver_.order(); }

  mesh::FrameState body(const coupling::VehicleState& vehicle) const;
  fluid::Frames frames(const coupling::VehicleState& vehicle) const;
  fluid::FrameFunction frame_function(const coupling::Trajectory& motion) const;
  coupling::VectorXd loads(Vec q, const coupling::VehicleState& vehicle);

  const Case& case_;
  Scales scales_;
  fluid::FlowSolver& solver_;
  const ZoneTree& zones_;
  coupling::Window window_;
  coupling::CoupledStep step_;
  std::vector<bool> is_wall_;    ///< of each patch: its loads are the body's
  std::vector<int> zone_rotor_;  ///< of each zone: the body's rotor that turns it, or −1
  double dt_ = 0;                ///< of the step begun, nondimensional
  fluid::StepReport report_;     ///< of the latest iterate
  std::optional<io::CsvTable> table_;
};

/// Frames of all zones at the start of a run.
fluid::Frames initial_frames(const Case& c, const ZoneTree& zones);

}  // namespace windhover::app
