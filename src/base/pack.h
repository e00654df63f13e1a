// Eight doubles as one value: the scalar type in which fluxes are computed for eight faces at once.
// Built on the compiler's vector types, so any x86-64 (or other) machine runs it; AVX-512 in one register.
#pragma once
#include <cmath>
#include <cstdint>
#include <cstring>

namespace windhover {

struct Pack {
  static constexpr int size = 8;
  typedef double Vector __attribute__((vector_size(64)));
  typedef std::int64_t Mask __attribute__((vector_size(64)));

  Vector v;

  Pack() = default;
  Pack(double s) : v{s, s, s, s, s, s, s, s} {}
  Pack(Vector x) : v(x) {}
  static Pack load(const double* p) { return *reinterpret_cast<const Vector*>(p); }  // 64-byte aligned
  static Pack load_unaligned(const double* p) {
    Pack x;
    std::memcpy(&x.v, p, sizeof x.v);
    return x;
  }
  void store(double* p) const { *reinterpret_cast<Vector*>(p) = v; }
  double operator[](int i) const { return v[i]; }

  Pack operator-() const { return -v; }
  Pack& operator+=(Pack b) { return v += b.v, *this; }
  Pack& operator-=(Pack b) { return v -= b.v, *this; }
  Pack& operator*=(Pack b) { return v *= b.v, *this; }
  friend Pack operator+(Pack a, Pack b) { return a.v + b.v; }
  friend Pack operator-(Pack a, Pack b) { return a.v - b.v; }
  friend Pack operator*(Pack a, Pack b) { return a.v * b.v; }
  friend Pack operator/(Pack a, Pack b) { return a.v / b.v; }
  friend Mask operator<(Pack a, Pack b) { return a.v < b.v; }
};

inline Pack select(Pack::Mask m, Pack a, Pack b) { return m ? a.v : b.v; }

inline Pack sqrt(Pack a) {
  Pack r;
  for (int i = 0; i < Pack::size; ++i) r.v[i] = std::sqrt(a.v[i]);
  return r;
}

inline Pack reciprocal(Pack a) { return 1.0 / a; }
inline Pack inverse_sqrt(Pack a) { return 1.0 / sqrt(a); }
inline double reciprocal(double a) { return 1.0 / a; }
inline double inverse_sqrt(double a) { return 1.0 / std::sqrt(a); }

inline Pack power(Pack a, double exponent) {
  Pack r;
  for (int i = 0; i < Pack::size; ++i) r.v[i] = std::pow(a.v[i], exponent);
  return r;
}

inline double power(double a, double exponent) { return std::pow(a, exponent); }
inline double select(bool m, double a, double b) { return m ? a : b; }

/// Rows become columns: out[i][j] = in[j][i].
inline void transpose(const Pack in[8], Pack out[8]) {
  using V = Pack::Vector;
  V a[8], b[8];
  for (int i = 0; i < 4; ++i) {  // pairs of rows 4 apart, halves exchanged
    a[i] = __builtin_shufflevector(in[i].v, in[i + 4].v, 0, 1, 2, 3, 8, 9, 10, 11);
    a[i + 4] = __builtin_shufflevector(in[i].v, in[i + 4].v, 4, 5, 6, 7, 12, 13, 14, 15);
  }
  for (int h = 0; h < 8; h += 4)
    for (int i = 0; i < 2; ++i) {  // rows 2 apart, quarters exchanged
      b[h + i] = __builtin_shufflevector(a[h + i], a[h + i + 2], 0, 1, 8, 9, 4, 5, 12, 13);
      b[h + i + 2] = __builtin_shufflevector(a[h + i], a[h + i + 2], 2, 3, 10, 11, 6, 7, 14, 15);
    }
  for (int i = 0; i < 8; i += 2) {  // neighbours
    out[i] = __builtin_shufflevector(b[i], b[i + 1], 0, 8, 2, 10, 4, 12, 6, 14);
    out[i + 1] = __builtin_shufflevector(b[i], b[i + 1], 1, 9, 3, 11, 5, 13, 7, 15);
  }
}

}  // namespace windhover
