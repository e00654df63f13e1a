// Boundary sums for all reconstructions (independent of the interior flux), and states on boundary faces.
#pragma once
#include "fluid/flux_kernels.h"

namespace windhover::fluid {

struct BoundaryKernels {
  template <class Number>
  using Sum = void (*)(const FaceInput&, BoundaryKind, const mesh::FaceBlockOf<Number>* blocks, int count,
                       RowOf<Number>* rates);
  Sum<double> residual[3];          ///< by Reconstruction
  Sum<double> derivative[3];        ///< along the derivative rows
  Sum<float> derivative_single[3];  ///< the same of rows of floats
  /// d(first-order boundary flux)/d(conserved state of the cell), times the area.
  void (*jacobian)(const FaceInput&, BoundaryKind, const mesh::FaceBlock&, BlockPack& block);
  /// States on the boundary faces of one block.
  State<Pack> (*state[3])(const FaceInput&, BoundaryKind, const mesh::FaceBlock&);
};

extern const BoundaryKernels kBoundaryKernels;

}  // namespace windhover::fluid
