// What is sought and what must balance in a trim: unknowns, the vehicle held there, and the forces that are left.
#pragma once
#include "coupling/balance_solver.h"
#include "coupling/trim_options.h"
#include "coupling/window.h"

namespace windhover::coupling {

/// A vehicle that is held: coordinates of its mount, and speeds of its rotors (rad/s).
struct Hold {
  body::Vec6 coordinates;
  VectorXd rotor_speed;
};

/// Mean loads of the air on a vehicle that is held.
struct MeanLoads {
  VectorXd loads;  ///< LoadLayout
  std::vector<body::Vec6> rotor_wrench =
      {};  ///< of each rotor's own walls: force, moment about the centre of gravity; inertial axes
};

class Equilibrium {
 public:
  /// `length` (m): largest change of a position from one try to the next. UserError naming the keys that cannot be.
  Equilibrium(const Window& window, const TrimOptions& options, double length);

  const std::vector<std::string>& unknowns() const { return unknown_names_; }
  const std::vector<std::string>& balanced() const { return balance_names_; }
  BalanceOptions solver_options() const;

  /// Where a vehicle is; what is no unknown is as at its start, whatever the state.
  Hold hold(const VehicleState& state) const;
  Hold hold(const VectorXd& u) const;
  VectorXd scaled_unknowns(const Hold& hold) const;
  /// Unknowns in SI units, in their order.
  VectorXd values(const Hold& hold) const { return scaled_unknowns(hold).cwiseProduct(unknown_scale_); }

  /// The vehicle at time t with these rates and rotor angles; where it is free, it has the velocity of its start, with
  /// which it has moved along for `moved_s`.
  VehicleState state(double t, const Hold& hold, const body::Vec6& rates, const VectorXd& rotor_angle,
                     double moved_s = 0) const;
  /// The same without rates, the rotors at angle 0.
  VehicleState state(double t, const Hold& hold) const;

  /// What is left of the forces (N, N m), and the same over their scales.
  VectorXd unbalanced(const Hold& hold, const VectorXd& loads) const;
  VectorXd residual(const Hold& hold, const VectorXd& loads) const {
    return unbalanced(hold, loads).cwiseQuotient(force_scale_);
  }

  /// d(residual)/du if the loads on each rotor turned with the body and grew with the square of its speed, and those on
  /// the rest stayed as they are. Springs and weight are exact.
  MatrixXd model_jacobian(const Hold& hold, const MeanLoads& mean) const;

 private:
  void choose_unknowns(const TrimOptions& options, double length);
  void choose_balance(const TrimOptions& options);
  void set_scales(const TrimOptions& options);
  void require_steady() const;
  int speed_index(int freedom) const;
  MeanLoads modelled(const Hold& there, const Hold& hold, const MeanLoads& mean) const;

  const Window& window_;
  double tolerance_;
  int max_evaluations_;
  std::vector<int> unknowns_;  ///< motions 0 to 5, then rotors
  std::vector<int> balance_;   ///< motions
  std::vector<std::string> unknown_names_, balance_names_;
  VectorXd unknown_scale_, force_scale_;
  Hold start_;
};

}  // namespace windhover::coupling
