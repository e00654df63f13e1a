// Torque-free asymmetric top (Landau and Lifshitz, Mechanics, section 37): principal moments I1 < I2 < I3 and
// L² > 2 E I2, so that the angular momentum circles about axis 3; at t = 0 there is no rotation about axis 2.
#pragma once
#include <Eigen/Core>

#include "oracle/jacobi_elliptic.h"

namespace windhover::oracle {

struct FreeTop {
  Eigen::Vector3d moments, omega_0;  ///< omega_0[1] = 0

  double twice_energy() const { return moments.dot(omega_0.cwiseAbs2()); }
  double momentum_squared() const { return (moments.cwiseProduct(omega_0)).squaredNorm(); }
  /// Of the argument of the elliptic functions.
  double rate() const {
    return std::sqrt((moments[2] - moments[1]) * (momentum_squared() - twice_energy() * moments[0]) / moments.prod());
  }
  double k2() const {
    return (moments[1] - moments[0]) * (twice_energy() * moments[2] - momentum_squared()) /
           ((moments[2] - moments[1]) * (momentum_squared() - twice_energy() * moments[0]));
  }
  /// After which the angular velocity repeats in body axes.
  double period() const { return 4 * quarter_period(k2()) / rate(); }

  Eigen::Vector3d omega(double t) const {
    const auto& I = moments;
    const Jacobi j = jacobi(rate() * t, k2());
    const double middle = std::sqrt((twice_energy() * I[2] - momentum_squared()) / (I[1] * (I[2] - I[1])));
    return {omega_0[0] * j.cn, middle * j.sn, omega_0[2] * j.dn};
  }

  /// Angle by which the body has turned about the angular momentum after one period.
  double turn_per_period() const {
    constexpr int kPoints = 200;  // of the trapezoidal rule, which is spectral for a periodic function
    double sum = 0;
    for (int i = 0; i < kPoints; ++i) {
      const Eigen::Vector3d w = omega(period() * i / kPoints), L = moments.cwiseProduct(w);
      sum += (L[0] * w[0] + L[1] * w[1]) / (L[0] * L[0] + L[1] * L[1]);
    }
    return std::sqrt(momentum_squared()) * period() * sum / kPoints;
  }
};

}  // namespace windhover::oracle
