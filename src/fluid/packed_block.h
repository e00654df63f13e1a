// 5x5 blocks of floats in 32 bytes, for what is read often and need not be exact.
#pragma once
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "fluid/five_columns.h"

namespace windhover::fluid {

/// 25 signed bytes and what they are to be multiplied with. Word i < 5: row i of the first four columns, the first in the
/// lowest byte; words 5 and 6: the last column. A byte is read with those below it in its word, as digits behind the
/// point, and was rounded with them.
struct alignas(32) PackedBlock {
  std::uint32_t word[7];
  float scale;
};

/// Rows and columns of a block.
inline constexpr int kBlockSize = 5;

/// A block whose columns are padded to whole registers.
struct Padded {
  Column column[kBlockSize];
};

inline Column times(const Padded& block, const float* x) {
  Column sum = block.column[0] * x[0];
  for (int k = 1; k < kBlockSize; ++k) sum += block.column[k] * x[k];
  return sum;
}

typedef std::int32_t Words __attribute__((vector_size(32)));

/// The words of a block as its columns over its scale.
class Columns {
 public:
  explicit Columns(const PackedBlock& block) : words_(std::bit_cast<Words>(block)) {}
  template <int k>
  Column at() const {
    if constexpr (k < 4)
      return __builtin_convertvector(words_ << 8 * (3 - k), Column);
    else
      return __builtin_convertvector(
          __builtin_shufflevector(words_, words_, 5, 5, 5, 5, 6, 6, 6, 6) << Words{24, 16, 8, 0, 24, 16, 8, 0}, Column);
  }

 private:
  Words words_;
};

/// block · x
inline Column times(const PackedBlock& block, const float* x) {
  const Columns columns(block);
  Column sum = columns.at<0>() * x[0];
  sum += columns.at<1>() * x[1];
  sum += columns.at<2>() * x[2];
  sum += columns.at<3>() * x[3];
  sum += columns.at<4>() * x[4];
  return sum * block.scale;
}

/// Puts a byte above the k bytes of each word, so that the word over 2^8k is as near to `wanted` as it can be.
inline void put_byte(const Column& wanted, int k, Words& words) {
  constexpr float kUp = 128.5;  // conversion cuts off what is behind the point
  const Column rest = wanted - __builtin_convertvector(words, Column) / static_cast<float>(1 << 8 * k);
  words |= ((__builtin_convertvector(rest + kUp, Words) - static_cast<int>(kUp)) & 0xff) << 8 * k;
}

inline float largest_entry(const Padded& block) {
  float largest = 0;
  for (const Column& c : block.column)
    for (int i = 0; i < kBlockSize; ++i) largest = std::max(largest, std::abs(c[i]));
  return largest;
}

/// To nearest; what is not finite does not count, the pivots tell.
inline PackedBlock packed(const Padded& from) {
  constexpr float kMost = 127, kLeast = 1e-30f;
  const float largest = largest_entry(from);
  if (!(largest > kLeast && std::isfinite(largest))) return {};
  const float over = kMost / largest;
  Words words{}, last{};
  for (int k = 0; k < 4; ++k) {
    put_byte(from.column[k] * over, k, words);
    // the last column's rows, one byte of the same word after the other
    put_byte(Column{} + from.column[4][k] * over, k, last);
  }
  words[5] = last[0];
  last = Words{};
  put_byte(from.column[4] * over, 0, last);
  words[6] = last[4];
  PackedBlock block = std::bit_cast<PackedBlock>(words);
  block.scale = largest / kMost / (1 << 24);
  return block;
}

inline Padded unpacked(const PackedBlock& block) {
  const Columns columns(block);
  const float scale = block.scale;
  return {columns.at<0>() * scale, columns.at<1>() * scale, columns.at<2>() * scale, columns.at<3>() * scale,
          columns.at<4>() * scale};
}

}  // namespace windhover::fluid
