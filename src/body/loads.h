// Aerodynamic loads as polynomials in time over one step.
#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

namespace windhover::body {

/// Force (N) and torque about the centre of gravity (N m), both in inertial axes, on airframe and blades together;
/// then for each rotor the torque about its spin axis (N m, negative when the air brakes it).
struct LoadLayout {
  static constexpr int force = 0, torque = 3, rotor = 6;
  static int size(int rotors) { return 6 + rotors; }
};

/// The polynomial through one, two or three (time, loads) points: constant, linear, quadratic.
class LoadPolynomial {
 public:
  struct Point {
    double t;
    Eigen::VectorXd loads;
  };
  explicit LoadPolynomial(std::vector<Point> points);

  int size() const { return static_cast<int>(coefficients_[0].size()); }
  void evaluate(double t, std::span<double> loads) const;
  Eigen::VectorXd at(double t) const;

 private:
  std::vector<double> times_;
  std::vector<Eigen::VectorXd> coefficients_;  ///< Newton's divided differences
};

}  // namespace windhover::body
