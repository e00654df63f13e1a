// Eight doubles as one value: the scalar type in which fluxes are computed for eight faces at once.
// Built on the compiler's vector types, so any x86-64 (or other) machine runs it, in as many of its registers as eight
// doubles fill: one of AVX-512, two of AVX, four otherwise. A vector type wider than the registers would live in memory.
#pragma once
#include <cmath>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

namespace windhover {

#if defined(__AVX512F__)
inline constexpr int kRegister = 8;  ///< doubles in one
#elif defined(__AVX__)
inline constexpr int kRegister = 4;
#else
inline constexpr int kRegister = 2;
#endif

/// So many doubles: whole registers.
template <int lanes>
struct Lanes {
  static constexpr int size = lanes, kWidth = kRegister, kParts = lanes / kWidth;
  typedef double Part __attribute__((vector_size(8 * kWidth)));
  typedef std::int64_t MaskPart __attribute__((vector_size(8 * kWidth)));
  struct Mask {
    MaskPart part[kParts];
  };

  Part part[kParts];

  Lanes() = default;
  Lanes(double s) {
    for (Part& p : part) p = s - Part{};
  }
  template <class... P>
    requires(sizeof...(P) == kParts && (std::is_same_v<P, Part> && ...))
  explicit Lanes(const P&... parts) : part{parts...} {}

  /// Aligned to their size.
  static Lanes load(const double* p) {
    return each([p](int i) { return reinterpret_cast<const Part*>(p)[i]; });
  }
  static Lanes load_unaligned(const double* p) {
    return each([p](int i) { return load_part(p + kWidth * i); });
  }
  static Part load_part(const double* p) {
    Part x;
    std::memcpy(&x, p, sizeof x);
    return x;
  }
  void store(double* p) const {
    for (int i = 0; i < kParts; ++i) reinterpret_cast<Part*>(p)[i] = part[i];
  }
  void store_unaligned(double* p) const {
    for (int i = 0; i < kParts; ++i) std::memcpy(p + kWidth * i, &part[i], sizeof(Part));
  }
  double operator[](int i) const { return part[i / kWidth][i % kWidth]; }
  void set(int i, double s) { part[i / kWidth][i % kWidth] = s; }

  /// Those whose part i is f(i).
  template <class F>
  static Lanes each(F f) {
    Lanes x;
    for (int i = 0; i < kParts; ++i) x.part[i] = f(i);
    return x;
  }
  Lanes operator-() const {
    return each([&](int i) { return -part[i]; });
  }
  Lanes& operator+=(const Lanes& b) { return *this = *this + b; }
  Lanes& operator-=(const Lanes& b) { return *this = *this - b; }
  Lanes& operator*=(const Lanes& b) { return *this = *this * b; }
  friend Lanes operator+(const Lanes& a, const Lanes& b) {
    return each([&](int i) { return a.part[i] + b.part[i]; });
  }
  friend Lanes operator-(const Lanes& a, const Lanes& b) {
    return each([&](int i) { return a.part[i] - b.part[i]; });
  }
  friend Lanes operator*(const Lanes& a, const Lanes& b) {
    return each([&](int i) { return a.part[i] * b.part[i]; });
  }
  friend Lanes operator/(const Lanes& a, const Lanes& b) {
    return each([&](int i) { return a.part[i] / b.part[i]; });
  }
  friend Mask operator<(const Lanes& a, const Lanes& b) {
    Mask m;
    for (int i = 0; i < kParts; ++i) m.part[i] = a.part[i] < b.part[i];
    return m;
  }
  friend Lanes select(const Mask& m, const Lanes& a, const Lanes& b) {
    return each([&](int i) { return m.part[i] ? a.part[i] : b.part[i]; });
  }
};

using Pack = Lanes<8>;
using Register = Lanes<kRegister>;

inline Register part(const Pack& a, int i) { return Register(a.part[i]); }
inline void set_part(Pack& a, int i, const Register& r) { a.part[i] = r.part[0]; }

/// a in the first n lanes, 0 in the others.
template <int n>
Pack first_lanes(const Pack& a) {
  return Pack::each([&](int i) {
    Pack::MaskPart kept;
    for (int k = 0; k < Pack::kWidth; ++k) kept[k] = Pack::kWidth * i + k < n ? -1 : 0;
    return kept ? a.part[i] : Pack::Part{};
  });
}

template <int n>
Lanes<n> sqrt(const Lanes<n>& a) {
  return Lanes<n>::each([&](int i) {
    typename Lanes<n>::Part root;
    for (int k = 0; k < kRegister; ++k) root[k] = std::sqrt(a.part[i][k]);
    return root;
  });
}

template <int n>
Lanes<n> reciprocal(const Lanes<n>& a) {
  return 1.0 / a;
}
template <int n>
Lanes<n> inverse_sqrt(const Lanes<n>& a) {
  return 1.0 / sqrt(a);
}
inline double reciprocal(double a) { return 1.0 / a; }
inline double inverse_sqrt(double a) { return 1.0 / std::sqrt(a); }

template <int n>
Lanes<n> power(const Lanes<n>& a, double exponent) {
  Lanes<n> r;
  for (int i = 0; i < n; ++i) r.set(i, std::pow(a[i], exponent));
  return r;
}

inline double power(double a, double exponent) { return std::pow(a, exponent); }
inline double select(bool m, double a, double b) { return m ? a : b; }

namespace pack {

constexpr int kWidth = Pack::kWidth;
using Numbers = std::make_integer_sequence<int, kWidth>;

/// Exchanges what is not on the diagonal of the 2x2 blocks that `half` cuts out of two rows.
template <int half, int... k>
void exchange(Pack::Part& a, Pack::Part& b, std::integer_sequence<int, k...>) {
  const Pack::Part first = __builtin_shufflevector(a, b, (k & half ? kWidth + k - half : k)...);
  b = __builtin_shufflevector(a, b, (k & half ? kWidth + k : k + half)...);
  a = first;
}

template <int half = kWidth / 2>
void transpose_square(Pack::Part rows[kWidth]) {
  for (int i = 0; i < kWidth; ++i)
    if (!(i & half)) exchange<half>(rows[i], rows[i + half], Numbers());
  if constexpr (half > 1) transpose_square<half / 2>(rows);
}

/// Lanes from `first` on of a, then of b.
template <int first, int... k>
Pack::Part across(const Pack::Part& a, const Pack::Part& b, std::integer_sequence<int, k...>) {
  return __builtin_shufflevector(a, b, (k + first)...);
}
template <int first>
Pack::Part across(const Pack::Part& a, const Pack::Part& b) {
  return across<first>(a, b, Numbers());
}

/// A register of sixteen doubles, from `first` on; what would be beyond them means nothing.
template <int first>
Pack::Part window_part(const double* sixteen) {
  constexpr int last = 16 - kWidth, beyond = first < 16 ? first - last : 0;
  const auto aligned = [=](int i) { return *reinterpret_cast<const Pack::Part*>(sixteen + i); };
  if constexpr (first >= last)
    return across<beyond>(aligned(last), aligned(last));
  else if constexpr (kWidth == 8)
    return across<first>(aligned(0), aligned(8));
  else
    return Pack::load_part(sixteen + first);
}

template <int first, int... part>
Pack window(const double* sixteen, std::integer_sequence<int, part...>) {
  return Pack(window_part<first + kWidth * part>(sixteen)...);
}

}  // namespace pack

/// Rows become columns: out[i][j] = in[j][i].
inline void transpose(const Pack in[8], Pack out[8]) {
  for (int r = 0; r < Pack::kParts; ++r)
    for (int c = 0; c < Pack::kParts; ++c) {
      Pack::Part square[Pack::kWidth];
      for (int i = 0; i < Pack::kWidth; ++i) square[i] = in[Pack::kWidth * r + i].part[c];
      pack::transpose_square(square);
      for (int i = 0; i < Pack::kWidth; ++i) out[Pack::kWidth * c + i].part[r] = square[i];
    }
}

/// Eight of sixteen doubles (64-byte aligned), from `first` on; what would be beyond them means nothing.
template <int first>
Pack window(const double* sixteen) {
  return pack::window<first>(sixteen, std::make_integer_sequence<int, Pack::kParts>());
}

/// The first five lanes of each, one after the other in sixteen doubles (64-byte aligned); the last means nothing. A
/// template so that the branch of another width is not compiled.
template <class P = Pack>
void store_fives(const P& a, const P& b, const P& c, double* sixteen) {
  constexpr int width = P::kWidth;
  if constexpr (width == 8) {
    P(__builtin_shufflevector(a.part[0], b.part[0], 0, 1, 2, 3, 4, 8, 9, 10)).store(sixteen);
    P(__builtin_shufflevector(b.part[0], c.part[0], 3, 4, 8, 9, 10, 11, 12, 7)).store(sixteen + 8);
  } else {
    a.store(sixteen);
    b.store_unaligned(sixteen + 5);
    for (int i = 0; width * (i + 1) <= 6; ++i) std::memcpy(sixteen + 10 + width * i, &c.part[i], sizeof c.part[i]);
    constexpr int last = (6 - width) / width;
    const auto end = pack::across<(6 - width) % width>(c.part[last], c.part[last + 1]);
    std::memcpy(sixteen + 16 - width, &end, sizeof end);
  }
}

}  // namespace windhover
