// What moves the zones of a run: prescribed motions, a flight, or a trim that holds the vehicle.
#pragma once
#include <limits>
#include <optional>

#include "app/zone_tree.h"
#include "fluid/flow_solver.h"

namespace windhover::app {

class Mover {
 public:
  virtual ~Mover() = default;

  /// At the current state, nondimensional.
  virtual fluid::Frames frames() const = 0;
  virtual mesh::FrameState body() const = 0;

  struct Result {
    fluid::StepReport flow;            ///< `accepted` is that of flow and vehicle together
    int iterations = 0;                ///< of the coupling
    std::optional<double> error = {};  ///< of the step's size, where it is known
  };
  /// One step of this size (nondimensional), or none: then nothing has changed, and the reason is told. Collective.
  virtual Result advance(double dt) = 0;

  /// The time (nondimensional) that no step may cross; infinite when there is none.
  virtual double next_event() const { return std::numeric_limits<double>::infinity(); }

  /// All that a restart needs besides the flow, the same on every rank. Collective.
  virtual std::vector<double> state() { return {}; }
};

class PrescribedMotion : public Mover {
 public:
  PrescribedMotion(fluid::FlowSolver& solver, const ZoneTree& zones) : solver_(solver), zones_(zones) {}

  fluid::Frames frames() const override { return zones_.frames(solver_.state().time); }
  mesh::FrameState body() const override { return zones_.body(solver_.state().time); }
  Result advance(double dt) override {
    return {solver_.advance([this](double t) { return zones_.frames(t); }, dt), 0};
  }

 private:
  fluid::FlowSolver& solver_;
  const ZoneTree& zones_;
};

}  // namespace windhover::app
