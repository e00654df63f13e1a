// Forward-mode differentiation: a value and its derivative along one direction. T is double or Pack.
#pragma once
#include <cmath>
#include <type_traits>

#include "base/pack.h"

namespace windhover {

template <class T>
struct Dual {
  static constexpr bool kVectorised = !std::is_same_v<T, double>;
  T v, d;

  Dual() = default;
  Dual(double s) : v(s), d(0.0) {}
  Dual(const T& value, const T& derivative) : v(value), d(derivative) {}

  Dual operator-() const { return {-v, -d}; }
  Dual& operator+=(const Dual& b) { return *this = *this + b; }
  Dual& operator-=(const Dual& b) { return *this = *this - b; }

  friend Dual operator+(const Dual& a, const Dual& b) { return {a.v + b.v, a.d + b.d}; }
  friend Dual operator-(const Dual& a, const Dual& b) { return {a.v - b.v, a.d - b.d}; }
  friend Dual operator*(const Dual& a, const Dual& b) { return {a.v * b.v, a.d * b.v + a.v * b.d}; }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const T inverse = 1.0 / b.v;
    const T q = a.v * inverse;
    return {q, (a.d - q * b.d) * inverse};
  }
  // with constants
  friend Dual operator+(const Dual& a, double s) { return {a.v + s, a.d}; }
  friend Dual operator+(double s, const Dual& a) { return {s + a.v, a.d}; }
  friend Dual operator-(const Dual& a, double s) { return {a.v - s, a.d}; }
  friend Dual operator-(double s, const Dual& a) { return {s - a.v, -a.d}; }
  friend Dual operator*(const Dual& a, double s) { return {a.v * s, a.d * s}; }
  friend Dual operator*(double s, const Dual& a) { return {s * a.v, s * a.d}; }
  friend Dual operator/(const Dual& a, double s) { return a * (1.0 / s); }
  friend Dual operator/(double s, const Dual& b) {
    const T q = s / b.v;
    return {q, -q * b.d / b.v};
  }
  // with geometry, which has no derivative
  friend Dual operator*(const Dual& a, const T& s) requires kVectorised { return {a.v * s, a.d * s}; }
  friend Dual operator*(const T& s, const Dual& a) requires kVectorised { return {s * a.v, s * a.d}; }
  friend Dual operator+(const Dual& a, const T& s) requires kVectorised { return {a.v + s, a.d}; }
  friend Dual operator-(const Dual& a, const T& s) requires kVectorised { return {a.v - s, a.d}; }
  friend auto operator<(const Dual& a, const Dual& b) { return a.v < b.v; }
};

template <class T, class M>
Dual<T> select(const M& m, const Dual<T>& a, const Dual<T>& b) {
  return {select(m, a.v, b.v), select(m, a.d, b.d)};
}

template <class T>
Dual<T> sqrt(const Dual<T>& a) {
  using std::sqrt;
  const T root = sqrt(a.v);
  return {root, a.d / (2.0 * root)};
}

template <class T>
Dual<T> reciprocal(const Dual<T>& a) {
  const T q = reciprocal(a.v);
  return {q, -(q * q * a.d)};
}

template <class T>
Dual<T> inverse_sqrt(const Dual<T>& a) {
  const T q = inverse_sqrt(a.v);
  return {q, -0.5 * (q * q * q) * a.d};
}

template <class T>
Dual<T> power(const Dual<T>& a, double exponent) {
  const T value = power(a.v, exponent);
  return {value, exponent * value / a.v * a.d};
}

template <class Number>
auto part(const Dual<PackOf<Number>>& a, int i) {
  return Dual{part(a.v, i), part(a.d, i)};
}
template <class Number, class R>
void set_part(Dual<PackOf<Number>>& a, int i, const Dual<R>& r) {
  set_part(a.v, i, r.v), set_part(a.d, i, r.d);
}

/// The number type of a kernel's scalar, PackOf<Number> or Dual of it.
template <class T>
struct NumberOf;
template <class Number>
struct NumberOf<PackOf<Number>> {
  typedef Number type;
};
template <class Number>
struct NumberOf<Dual<PackOf<Number>>> {
  typedef Number type;
};
/// What has no derivative, beside T.
template <class T>
using PackFor = PackOf<typename NumberOf<T>::type>;

// Shared by all scalar types of the kernels.
template <class T>
T maximum(const T& a, const T& b) {
  return select(a < b, b, a);
}
template <class T>
T minimum(const T& a, const T& b) {
  return select(b < a, b, a);
}
template <class T>
T absolute(const T& a) {
  return select(a < T(0.0), -a, a);
}

}  // namespace windhover
