// Multigrid on aggregates of cells, smoothed by rational Runge–Kutta steps.
#pragma once
#include <memory>
#include <vector>

#include "base/petsc.h"
#include "fluid/coarsening.h"

namespace windhover::fluid {

class InterfaceCoupling;

/// A cycle corrects on the next coarser level, then smooths: one rational Runge–Kutta step over block ILU
/// (BlockIlu), on the coarsest level UMFPACK on every rank. The finest level takes the exact product, the
/// others first-order matrices (coarsening.h). Options reach the smoothers as …mg_levels_ and …mg_coarse_.
class Multigrid {
 public:
  /// `product`: what is to be solved; `matrix`: its first-order Jacobian (BAIJ), with values, but for `coupling`.
  Multigrid(Mat product, Mat matrix, int ilu_levels, InterfaceCoupling* coupling, const char* options_prefix);

  /// Coarse matrices and smoothers for the matrix's present values.
  void renew();
  /// x: one cycle for b, from zero. Nonlinear in b.
  void apply(Vec b, Vec x) { cycle(0, b, x); }

 private:
  struct Level {
    Mat matrix;
    KspHandle smoother;
    VecHandle x, b;  ///< solution and right-hand side, except on the finest level
  };
  void add_smoother(Level& level, Mat product, int ilu_levels, InterfaceCoupling* coupling, const char* options_prefix);
  void cycle(size_t level, Vec b, Vec x);

  std::vector<std::unique_ptr<Coarsening>> coarsening_;  ///< from level i to i + 1
  std::vector<Level> levels_;                            ///< finest first
  MatHandle coarsest_;                                   ///< entry by entry, as UMFPACK wants it
};

}  // namespace windhover::fluid
