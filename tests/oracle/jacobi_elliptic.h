// Jacobi's elliptic functions sn, cn, dn (u | k²) and the quarter period K(k²), by the arithmetic–geometric mean.
#pragma once
#include <cmath>
#include <numbers>

namespace windhover::oracle {

struct Jacobi {
  double sn, cn, dn;
};

inline double quarter_period(double k2) {
  double a = 1, b = std::sqrt(1 - k2);
  for (int i = 0; i < 10 && std::abs(a - b) > 1e-16 * a; ++i) {
    const double mean = (a + b) / 2;
    b = std::sqrt(a * b);
    a = mean;
  }
  return std::numbers::pi / (2 * a);
}

inline Jacobi jacobi(double u, double k2) {
  u = std::remainder(u, 4 * quarter_period(k2));
  constexpr int kLevels = 8;
  double a[kLevels + 1] = {1}, c[kLevels + 1] = {std::sqrt(k2)};
  double b = std::sqrt(1 - k2);
  for (int i = 0; i < kLevels; ++i) {
    a[i + 1] = (a[i] + b) / 2;
    c[i + 1] = (a[i] - b) / 2;
    b = std::sqrt(a[i] * b);
  }
  double phi = std::ldexp(a[kLevels] * u, kLevels);
  for (int i = kLevels; i > 0; --i) phi = (phi + std::asin(c[i] / a[i] * std::sin(phi))) / 2;
  const double sn = std::sin(phi);
  return {sn, std::cos(phi), std::sqrt(1 - k2 * sn * sn)};
}

}  // namespace windhover::oracle
