// What faces read of cells, rows of eight numbers (rho, u, v, w, p, Mach², 0, 0), of doubles one cache line, and gradients;
// and rows into which fluxes are summed.
#pragma once
#include "base/dual.h"
#include "mesh/face_block.h"

namespace windhover::fluid {

template <class Number>
struct alignas(8 * sizeof(Number)) RowOf {
  Number v[8];
};
using Row = RowOf<double>;
inline constexpr int kMach = 5;  ///< column of the cell's relative Mach number squared, at most 1

/// The three derivatives (zone axes) of the five variables, one after the other in cache lines.
template <class Number>
struct alignas(64) GradientRowOf {
  Number v[16];

  Number at(int direction, int variable) const { return v[5 * direction + variable]; }
  void store(const PackOf<Number> g[3]) { store_fives(g[0], g[1], g[2], v); }
  /// The change of the variables along an arm; what is in the columns after them means nothing.
  PackOf<Number> along(const Number* arm) const {
    return window<0>(v) * arm[0] + window<5>(v) * arm[1] + window<10>(v) * arm[2];
  }
};
using GradientRow = GradientRowOf<double>;

/// Faces in T's numbers, and where fluxes of T are summed.
template <class T>
using FaceBlockFor = mesh::FaceBlockOf<typename NumberOf<T>::type>;
template <class T>
using RateRow = RowOf<typename NumberOf<T>::type>;

/// What faces read of cells on both sides. Derivative fields (d...) are used by linearised kernels only.
template <class Number>
struct CellRows {
  const RowOf<Number>* cells = nullptr;
  const GradientRowOf<Number>* gradients = nullptr;
  const RowOf<Number>* d_cells = nullptr;
  const GradientRowOf<Number>* d_gradients = nullptr;
};

}  // namespace windhover::fluid
