// Eight numbers as one value: the scalar type in which fluxes are computed for eight faces at once.
// Built on the compiler's vector types, so any x86-64 (or other) machine runs it, in as many of its registers as they
// fill: doubles one of AVX-512, two of AVX, four otherwise. A vector type wider than the registers would live in memory.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

namespace windhover {

#if defined(__AVX512F__)
inline constexpr int kRegisterBytes = 64;
#elif defined(__AVX__)
inline constexpr int kRegisterBytes = 32;
#else
inline constexpr int kRegisterBytes = 16;
#endif

/// So many doubles or floats: whole registers, or the only one's lower half.
template <int lanes, class Number>
struct Lanes {
  static constexpr int size = lanes, kWidth = std::min<int>(lanes, kRegisterBytes / sizeof(Number)), kParts = lanes / kWidth;
  typedef std::conditional_t<sizeof(Number) == 8, std::int64_t, std::int32_t> Integer;
  typedef Number Part __attribute__((vector_size(sizeof(Number) * kWidth)));
  typedef Integer MaskPart __attribute__((vector_size(sizeof(Number) * kWidth)));
  struct Mask {
    MaskPart part[kParts];
  };

  Part part[kParts];

  Lanes() = default;
  Lanes(double s) {
    for (Part& p : part) p = static_cast<Number>(s) - Part{};
  }
  template <class... P>
    requires(sizeof...(P) == kParts && (std::is_same_v<P, Part> && ...))
  explicit Lanes(const P&... parts) : part{parts...} {}

  /// Aligned to their size.
  static Lanes load(const Number* p) {
    return each([p](int i) { return reinterpret_cast<const Part*>(p)[i]; });
  }
  static Lanes load_unaligned(const Number* p) {
    return each([p](int i) { return load_part(p + kWidth * i); });
  }
  static Part load_part(const Number* p) {
    Part x;
    std::memcpy(&x, p, sizeof x);
    return x;
  }
  void store(Number* p) const {
    for (int i = 0; i < kParts; ++i) reinterpret_cast<Part*>(p)[i] = part[i];
  }
  void store_unaligned(Number* p) const {
    for (int i = 0; i < kParts; ++i) std::memcpy(p + kWidth * i, &part[i], sizeof(Part));
  }
  Number operator[](int i) const { return part[i / kWidth][i % kWidth]; }
  void set(int i, Number s) { part[i / kWidth][i % kWidth] = s; }

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

/// Eight, of which a face has one.
template <class Number>
using PackOf = Lanes<8, Number>;
using Pack = PackOf<double>;

/// One register of them.
template <class P>
struct RegisterOf;
template <int lanes, class Number>
struct RegisterOf<Lanes<lanes, Number>> {
  typedef Lanes<Lanes<lanes, Number>::kWidth, Number> type;
};

template <class Number>
auto part(const PackOf<Number>& a, int i) {
  return typename RegisterOf<PackOf<Number>>::type(a.part[i]);
}
template <class Number, class R>
void set_part(PackOf<Number>& a, int i, const R& r) {
  a.part[i] = r.part[0];
}

/// a in the first n lanes, 0 in the others.
template <int n, class Number>
PackOf<Number> first_lanes(const PackOf<Number>& a) {
  using P = PackOf<Number>;
  return P::each([&](int i) {
    typename P::MaskPart kept;
    for (int k = 0; k < P::kWidth; ++k) kept[k] = P::kWidth * i + k < n ? -1 : 0;
    return kept ? a.part[i] : typename P::Part{};
  });
}

template <int n, class Number>
Lanes<n, Number> sqrt(const Lanes<n, Number>& a) {
  using L = Lanes<n, Number>;
  return L::each([&](int i) {
    typename L::Part root;
    for (int k = 0; k < L::kWidth; ++k) root[k] = std::sqrt(a.part[i][k]);
    return root;
  });
}

template <int n, class Number>
Lanes<n, Number> reciprocal(const Lanes<n, Number>& a) {
  return 1.0 / a;
}
template <int n, class Number>
Lanes<n, Number> inverse_sqrt(const Lanes<n, Number>& a) {
  return 1.0 / sqrt(a);
}
inline double reciprocal(double a) { return 1.0 / a; }
inline double inverse_sqrt(double a) { return 1.0 / std::sqrt(a); }

template <int n, class Number>
Lanes<n, Number> power(const Lanes<n, Number>& a, double exponent) {
  Lanes<n, Number> r;
  for (int i = 0; i < n; ++i) r.set(i, std::pow(a[i], exponent));
  return r;
}

inline double power(double a, double exponent) { return std::pow(a, exponent); }
inline double select(bool m, double a, double b) { return m ? a : b; }

namespace pack {

/// Exchanges what is not on the diagonal of the 2x2 blocks that `half` cuts out of two rows.
template <int half, class Part, int... k>
void exchange(Part& a, Part& b, std::integer_sequence<int, k...>) {
  constexpr int width = sizeof...(k);
  const Part first = __builtin_shufflevector(a, b, (k & half ? width + k - half : k)...);
  b = __builtin_shufflevector(a, b, (k & half ? width + k : k + half)...);
  a = first;
}

template <int width, int half = width / 2, class Part>
[[gnu::always_inline]] inline void transpose_square(Part* rows) {
  for (int i = 0; i < width; ++i)
    if (!(i & half)) exchange<half>(rows[i], rows[i + half], std::make_integer_sequence<int, width>());
  if constexpr (half > 1) transpose_square<width, half / 2>(rows);
}

/// Lanes from `first` on of a, then of b.
template <int first, class Part, int... k>
Part across(const Part& a, const Part& b, std::integer_sequence<int, k...>) {
  return __builtin_shufflevector(a, b, (k + first)...);
}
template <int first, class P>
typename P::Part across(const typename P::Part& a, const typename P::Part& b) {
  return across<first>(a, b, std::make_integer_sequence<int, P::kWidth>());
}

/// A register of sixteen numbers, from `first` on; what would be beyond them means nothing.
template <int first, class P, class Number>
typename P::Part window_part(const Number* sixteen) {
  constexpr int last = 16 - P::kWidth, beyond = first < 16 ? first - last : 0;
  const auto aligned = [=](int i) { return *reinterpret_cast<const typename P::Part*>(sixteen + i); };
  if constexpr (first >= last)
    return across<beyond, P>(aligned(last), aligned(last));
  else if constexpr (sizeof(typename P::Part) == 64)  // a load would cross two cache lines
    return across<first, P>(aligned(0), aligned(8));
  else
    return P::load_part(sixteen + first);
}

template <int first, class P, class Number, int... part>
P window(const Number* sixteen, std::integer_sequence<int, part...>) {
  return P(window_part<first + P::kWidth * part, P>(sixteen)...);
}

/// As many floats as a register holds doubles.
typedef float Half __attribute__((vector_size(4 * Pack::kWidth)));

template <int... k>
PackOf<float>::Part joined(const Half& a, const Half& b, std::integer_sequence<int, k...>) {
  return __builtin_shufflevector(a, b, k...);
}
template <int first, int... k>
Half half_of(const PackOf<float>::Part& a, std::integer_sequence<int, k...>) {
  return __builtin_shufflevector(a, a, (k + first)...);
}

constexpr int kHalves = Pack::kParts / PackOf<float>::kParts;  // in a register of floats; 1 where one is but half full

}  // namespace pack

/// Rounded to floats, or as they are.
template <class Number>
PackOf<Number> rounded_to(const Pack& a) {
  if constexpr (std::is_same_v<Number, double>)
    return a;
  else
    return PackOf<float>::each([&](int i) {
      using pack::kHalves;
      const auto half = [&](int k) { return __builtin_convertvector(a.part[kHalves * i + k], pack::Half); };
      return pack::joined(half(0), half(kHalves - 1), std::make_integer_sequence<int, PackOf<float>::kWidth>());
    });
}

template <class Number>
  requires std::is_same_v<Number, float>
PackOf<float> rounded_to(const PackOf<float>& a) {
  return a;
}

inline Pack widened(const Pack& a) { return a; }
inline Pack widened(const PackOf<float>& a) {
  constexpr std::make_integer_sequence<int, Pack::kWidth> lanes;
  return Pack::each([&](int i) {
    const auto& part = a.part[i / pack::kHalves];
    const pack::Half half = i % pack::kHalves ? pack::half_of<(pack::kHalves - 1) * Pack::kWidth>(part, lanes)
                                              : pack::half_of<0>(part, lanes);
    return __builtin_convertvector(half, Pack::Part);
  });
}

/// Rows become columns: out[i][j] = in[j][i].
template <class Number>
[[gnu::always_inline]] inline void transpose(const PackOf<Number> in[8], PackOf<Number> out[8]) {
  using P = PackOf<Number>;
  constexpr int width = P::kWidth;
  for (int r = 0; r < P::kParts; ++r)
    for (int c = 0; c < P::kParts; ++c) {
      typename P::Part square[width];
      for (int i = 0; i < width; ++i) square[i] = in[width * r + i].part[c];
      pack::transpose_square<width>(square);
      for (int i = 0; i < width; ++i) out[width * c + i].part[r] = square[i];
    }
}

/// Eight of sixteen numbers (64-byte aligned), from `first` on; what would be beyond them means nothing.
template <int first, class Number>
PackOf<Number> window(const Number* sixteen) {
  using P = PackOf<Number>;
  return pack::window<first, P>(sixteen, std::make_integer_sequence<int, P::kParts>());
}

/// The first five lanes of each, one after the other in sixteen numbers (64-byte aligned); the last means nothing.
template <class Number>
[[gnu::always_inline]] inline void store_fives(const PackOf<Number>& a, const PackOf<Number>& b, const PackOf<Number>& c, Number* sixteen) {
  using P = PackOf<Number>;
  constexpr int width = P::kWidth;
  if constexpr (width == 8) {
    P(__builtin_shufflevector(a.part[0], b.part[0], 0, 1, 2, 3, 4, 8, 9, 10)).store(sixteen);
    P(__builtin_shufflevector(b.part[0], c.part[0], 3, 4, 8, 9, 10, 11, 12, 7)).store(sixteen + 8);
  } else {
    a.store(sixteen);
    b.store_unaligned(sixteen + 5);
    for (int i = 0; width * (i + 1) <= 6; ++i) std::memcpy(sixteen + 10 + width * i, &c.part[i], sizeof c.part[i]);
    constexpr int last = (6 - width) / width;
    const auto end = pack::across<(6 - width) % width, P>(c.part[last], c.part[last + 1]);
    std::memcpy(sixteen + 16 - width, &end, sizeof end);
  }
}

}  // namespace windhover
