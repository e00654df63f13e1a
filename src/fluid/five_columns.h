// Products of 5x5 blocks of floats with five floats, a column of a block in one register.
#pragma once
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

/// block · x; block: 25 numbers by columns, and three after them are read.
inline Column times(const float* block, const float* x) {
  Column sum = load_column(block) * x[0];
  for (int k = 1; k < 5; ++k) sum += load_column(block + 5 * k) * x[k];
  return sum;
}

}  // namespace windhover::fluid
