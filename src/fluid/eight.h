// Numbers of eight cells, from arrays that have them cell by cell.
#pragma once
#include <algorithm>

#include "base/pack.h"
#include "mesh/mesh.h"

namespace windhover::fluid {

/// Eight items of N numbers each, one after the other: those in the array, or a copy padded with zeros where fewer than
/// eight or what load_columns() reads after them would lie beyond the array's end.
template <int N, class Scalar = double>
struct Eight {
  Scalar copy[8 * N + 8];
  const Scalar* first;

  Eight(const Scalar* data, mesh::Index left) : first(data) {
    if (N * left >= 7 * N + 8) return;
    std::fill(std::begin(copy), std::end(copy), Scalar{});
    std::copy_n(data, N * std::min<mesh::Index>(left, 8), copy);
    first = copy;
  }
};

/// Eight items of N numbers each as columns, of which the first N mean something.
template <int N, class Number, class Scalar>
inline void load_columns(const Eight<N, Scalar>& items, PackOf<Number> columns[8]) {
  PackOf<Number> rows[8];
  for (int j = 0; j < 8; ++j) rows[j] = rounded_to<Number>(PackOf<Scalar>::load_unaligned(items.first + N * j));
  transpose(rows, columns);
}

}  // namespace windhover::fluid
