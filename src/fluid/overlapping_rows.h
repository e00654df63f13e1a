// This rank's rows of a distributed matrix of 5x5 blocks, with one layer of other ranks' rows around them: the part that
// restricted additive Schwarz (Cai and Sarkis, SIAM J. Sci. Comput. 21 (1999) 792) solves on each rank.
#pragma once
#include <vector>

#include "base/petsc.h"
#include "fluid/block_matrix.h"

namespace windhover::fluid {

/// Rows and columns: those that this rank's rows are coupled with on lower ranks, its own, those on higher ranks.
class OverlappingRows {
 public:
  /// Of a BAIJ matrix. Collective.
  explicit OverlappingRows(Mat matrix);
  ~OverlappingRows();
  OverlappingRows(const OverlappingRows&) = delete;
  OverlappingRows& operator=(const OverlappingRows&) = delete;

  int rows() const { return before_ + own_ + after_; }
  int before() const { return before_; }
  int own() const { return own_; }
  /// Columns column[start[i]] to column[start[i + 1] - 1] of row i, ascending.
  struct Pattern {
    std::vector<int> start, column;
  };
  Pattern pattern() const;

  /// From own rows to those before and after them, as they stand at the two ends of a list of so many rows.
  SfHandle forest(size_t size) const;
  /// Where each block is, in the order of the pattern, until the matrix changes. Collective.
  std::vector<const double*> blocks();

 private:
  template <class Visit>
  void for_each_block(Visit visit) const;
  void fetch(MatReuse reuse);

  Mat matrix_;
  BlockParts parts_;
  IsHandle other_rows_, columns_;  ///< on more than one rank
  Mat* others_ = nullptr;          ///< these rows, in these columns
  int before_ = 0, own_ = 0, after_ = 0;
};

}  // namespace windhover::fluid
