// From one level of the multigrid method to the next: aggregates of cells, and the matrix between them.
#pragma once
#include <vector>

#include "base/petsc.h"

namespace windhover::fluid {

/// The coarse matrix is the sum of the fine one's 5x5 blocks over pairs of aggregates: the first-order scheme on
/// agglomerated cells. No aggregate reaches over two ranks, but the coarse matrix couples those of different ranks.
class Coarsening {
 public:
  /// `fine`: BAIJ. Aggregates are chosen by the sizes of the blocks that it has now, and kept.
  explicit Coarsening(Mat fine);
  Coarsening(const Coarsening&) = delete;
  Coarsening& operator=(const Coarsening&) = delete;

  Mat matrix() const { return matrix_; }
  /// The coarse matrix of the fine one's present values.
  void sum_blocks();
  /// Each aggregate's sum.
  void restrict_to_coarse(Vec fine, Vec coarse) const;
  /// Each cell gets its aggregate's values.
  void prolong(Vec coarse, Vec fine) const;

 private:
  Mat fine_;
  MatHandle matrix_;
  std::vector<int> aggregate_;  ///< of each of this rank's rows
  std::vector<int> slot_;       ///< where each block of the fine matrix is added, this rank's own columns first
};

}  // namespace windhover::fluid
