// Time schemes as tables of coefficients.
#pragma once
#include <string>

namespace windhover::fluid {

/// Runge–Kutta in Butcher's form, at most three stages, for V dq/dt + R(q, t) = 0:
///   V (q_i − q_n)/Δt + Σ_j a_ij R_j = 0,   R_j at t_n + c_j Δt.
/// Implicit schemes here end on their last stage; explicit ones add b. `bdf2` replaces q_n by a combination with q_{n−1}.
struct TimeScheme {
  const char* name;
  int order;
  int stages;
  bool implicit;
  bool bdf2;
  bool damped;  ///< may be blended with BDF2
  double a[3][3];
  double b[3];  ///< explicit schemes only
  double c[3];
};

/// Crank–Nicolson, backward Euler, BDF2 (variable steps), SDIRK2 (L-stable, Alexander 1977), SSP-RK3 (Shu & Osher 1988).
extern const TimeScheme kTimeSchemes[5];

/// UserError naming the valid schemes when there is no such one.
const TimeScheme& time_scheme(const std::string& name);

/// Blended as (1 − w) Crank–Nicolson + w BDF2 (a Beam–Warming scheme, J. Comput. Phys. 22 (1976) 87) a step stays of second
/// order at any step ratio; what is stiff is multiplied by −(1 − w)/(1 + w) from step to step instead of −1, and the leading
/// error by 1 + 3w.
/// BDF2 with step ratio r = Δt_n / Δt_{n−1}: q − h0 q_n − h1 q_{n−1} + a Δt R/V = 0.
struct Bdf2Coefficients {
  double h0, h1, a;
};
Bdf2Coefficients bdf2_coefficients(double r);

}  // namespace windhover::fluid
