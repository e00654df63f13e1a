// Products of 5x5 blocks of floats or bfloat16 with five floats, a column of a block in one register.
#pragma once
#include <cstdint>
#include <cstring>

namespace windhover::fluid {

/// A column of a block and three numbers after it that mean nothing.
typedef float Column __attribute__((vector_size(32)));

/// Eight numbers are read.
inline Column load_column(const float* p) {
  Column c;
  std::memcpy(&c, p, sizeof c);
  return c;
}

/// The upper halves of floats.
using Bfloat16 = std::uint16_t;

inline Column load_column(const Bfloat16* p) {
  typedef Bfloat16 Halves __attribute__((vector_size(16)));
  typedef std::uint32_t Wholes __attribute__((vector_size(32)));
  Halves halves;
  std::memcpy(&halves, p, sizeof halves);
  const Wholes bits = __builtin_convertvector(halves, Wholes) << 16;
  Column c;
  std::memcpy(&c, &bits, sizeof c);
  return c;
}

/// block · x; block: 25 numbers by columns, and three after them are read.
template <class Number>
inline Column times(const Number* block, const float* x) {
  Column sum = load_column(block) * x[0];
  for (int k = 1; k < 5; ++k) sum += load_column(block + 5 * k) * x[k];
  return sum;
}

}  // namespace windhover::fluid
