// A vehicle that is held, and moved smoothly from one place to the next while the flow goes on: what a trim tries.
#pragma once
#include "app/flight.h"

namespace windhover::app {

class HeldFlight : public Mover {
 public:
  /// `length`: see coupling::Equilibrium. UserError: also for an unknown rotor without walls.
  HeldFlight(const Case& c, fluid::FlowSolver& solver, const ZoneTree& zones);

  const coupling::Equilibrium& equilibrium() const { return equilibrium_; }

  /// Holds it from now on where it starts, or, with the vehicle of a checkpoint, where that is. Collective.
  void start(const std::vector<double>& checkpoint);
  /// Moves on from where it is now, and is there after that many seconds; 0: at once.
  void move_to(const coupling::Hold& hold, double duration_s);

  /// Where it is held, or on the way to.
  const coupling::Hold& hold() const { return to_; }

  /// Loads of the current flow. Collective.
  coupling::MeanLoads air() { return flight_.air(solver_.state().q, vehicle(time())); }

  fluid::Frames frames() const override { return flight_.frames(vehicle(time())); }
  mesh::FrameState body() const override { return flight_.body(vehicle(time())); }
  Result advance(double dt) override;

  /// As a flight would save it that is at rest here, its controller in the states that keep the rotors' speeds.
  std::vector<double> state() override;
  /// What that controller does: the largest difference of a commanded from the actual speed over the latter, and the
  /// fastest rate of its states.
  struct Control {
    double speed_error = 0, state_rate = 0;
  };
  Control control();

 private:
  struct Moment {
    coupling::Hold hold;
    body::Vec6 rates;
    coupling::VectorXd angle;
  };
  double time() const { return solver_.state().time * scale_s_; }
  Moment moment(double t) const;
  coupling::VehicleState vehicle(double t) const;
  coupling::VehicleState at_rest();

  fluid::FlowSolver& solver_;
  double scale_s_;
  Flight flight_;
  coupling::Equilibrium equilibrium_;
  coupling::Hold from_, to_;
  coupling::VectorXd angle_;  ///< of the rotors when it left
  double left_s_ = 0, duration_s_ = 0;
};

}  // namespace windhover::app
