// A time step of vehicle and air together: numerics.md, the fixed point of one function
//   G(x) = loads(fluid step(pose(vehicle over the step under loads that end at x))).
#pragma once
#include <functional>

#include "coupling/schemes.h"
#include "coupling/window.h"

namespace windhover::coupling {

/// The vehicle at a part (0 to 1) of the step.
using Trajectory = std::function<VehicleState(double part)>;

/// The air as the coupling sees it, SI. Every rank gets and gives the same.
class FluidSide {
 public:
  virtual ~FluidSide() = default;

  /// Loads (LoadLayout) of the accepted flow on the vehicle.
  virtual VectorXd loads(const VehicleState& vehicle) = 0;

  /// Starts a step of `dt` from the accepted flow; the trajectory's start is where the flow was accepted.
  virtual void begin(const Trajectory& motion, double dt) = 0;
  struct Answer {
    bool converged = false;  ///< the flow's equations hold to their tolerance
    bool failed = false;     ///< and going on would not help
    std::string reason;
    VectorXd loads;  ///< at the end of the step
  };
  /// Improves the flow at the end of the step for this motion, with at most `newton` iterations (0: until it is solved).
  virtual Answer iterate(const Trajectory& motion, int newton) = 0;
  virtual void accept() = 0;

  /// Order in time of the step begun; loads are constant over a step of first order.
  virtual int order() const = 0;
};

struct Iteration {
  double load_residual = 0, pose_residual = 0, relaxation = 0;
  bool accepted = false;
};

struct StepResult {
  bool accepted = false;
  std::string reason;
  std::optional<double> error;  ///< load_error() of a step on which vehicle and air agree
  std::vector<Iteration> iterations;
};

/// Everything but the flow itself that the next step depends on.
struct CoupledState {
  VehicleState vehicle;
  std::vector<body::LoadPolynomial::Point> loads;  ///< of the latest accepted steps, the current state's last
};

/// What sizes are compared with where the case does not say.
struct ReferenceSizes {
  double length;  ///< m
  double force;   ///< N: round-off of the fluid's forces
};

class CoupledStep {
 public:
  CoupledStep(const Window& window, FluidSide& fluid, const CouplingOptions& options, const ReferenceSizes& reference);

  const CoupledState& state() const { return state_; }

  /// From this vehicle and the accepted flow.
  void start(const VehicleState& vehicle);
  void start() { start(window_.start()); }

  /// One step to `end`. Not accepted: state and flow are as before, and the reason is told.
  StepResult advance(double end);

  /// The state, and what the scheme carries from step to step, as numbers; the same on every rank.
  std::vector<double> pack() const;
  /// UserError: of another vehicle.
  void restore(std::span<const double> packed);

 private:
  class Problem;

  const Window& window_;
  FluidSide& fluid_;
  CouplingOptions options_;
  const SchemeEntry& entry_;
  std::unique_ptr<Scheme> scheme_;
  ReferenceSizes reference_;
  CoupledState state_;
};

}  // namespace windhover::coupling
