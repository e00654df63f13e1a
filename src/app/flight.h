// A run whose body moves under the air's loads: the flow solver and the vehicle, step by step together.
#pragma once
#include "app/mover.h"
#include "app/vehicle.h"
#include "coupling/coupled_step.h"
#include "coupling/equilibrium.h"
#include "io/csv.h"

namespace windhover::app {

class Flight : public Mover, private coupling::FluidSide {
 public:
  Flight(const Case& c, fluid::FlowSolver& solver, const ZoneTree& zones);

  mesh::FrameState body() const override { return body(step_.state().vehicle); }
  fluid::Frames frames() const override { return frames(step_.state().vehicle); }
  /// The same for a vehicle that is elsewhere.
  mesh::FrameState body(const coupling::VehicleState& vehicle) const;
  fluid::Frames frames(const coupling::VehicleState& vehicle) const;

  /// From the vehicle's start, or from there, with the loads of the initial flow; once it is set. Collective, as all that
  /// follows.
  void start() { start(window_.start()); }
  void start(const coupling::VehicleState& vehicle) { step_.start(vehicle); }
  /// From the vehicle of another run's checkpoint, at t = 0.
  void start_from(std::span<const double> state);
  /// Opens coupling.csv; `last_step`: continue it from there.
  void open(const std::filesystem::path& directory, std::optional<std::int64_t> last_step);

  Result advance(double dt) override;
  double next_event() const override;

  std::vector<double> state() override { return step_.pack(); }
  void restore(std::span<const double> state) { step_.restore(state); }

  const coupling::Window& window() const { return window_; }
  const coupling::VehicleState& vehicle() const { return step_.state().vehicle; }
  /// Loads of a flow on the vehicle, and those on the walls that turn with each of its rotors.
  coupling::MeanLoads air(Vec q, const coupling::VehicleState& vehicle);
  /// Some walls turn with the rotor.
  bool has_walls(int rotor) const;

 private:
  coupling::VectorXd loads(const coupling::VehicleState& vehicle) override;
  void begin(const coupling::Trajectory& motion, double dt) override;
  Answer iterate(const coupling::Trajectory& motion, int newton) override;
  void accept() override { solver_.accept(); }
  int order() const override { return solver_.order(); }

  fluid::FrameFunction frame_function(const coupling::Trajectory& motion) const;

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
