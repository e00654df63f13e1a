// Incomplete LU factors of a matrix of 5x5 blocks, kept in bytes and applied in single precision: what fill they leave out
// is worth more than the digits.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "fluid/packed_block.h"

namespace windhover::fluid {

/// Rows of a right side that are not as given, or not given, ascending, and the five values of each.
struct ChangedRows {
  std::span<const int> rows;
  const float* values = nullptr;
};

class BlockIlu {
 public:
  struct Rows {
    int first, count;
  };
  /// Pattern of n block rows: columns column[start[i]] to column[start[i + 1] - 1] in ascending order, the diagonal
  /// among them. `levels` of fill: Saad, Iterative Methods for Sparse Linear Systems, 2nd ed., section 10.3.3.
  BlockIlu(int n, const int* start, const int* column, int levels) : BlockIlu(n, start, column, levels, {0, n}) {}
  /// Right sides and solutions have the rows `given` alone; the others' right sides are always changed ones.
  BlockIlu(int n, const int* start, const int* column, int levels, Rows given);

  /// Where the blocks are, each by columns, in the order of the pattern. False: some pivot cannot be inverted.
  bool factor(std::span<const double* const> blocks);
  /// x = U⁻¹ L⁻¹ b, five values a row, with `changed` in place of some.
  void solve(const float* b, float* x, const ChangedRows& changed = {});
  /// x = U⁻¹ b of one row alone.
  void solve_row(int row, const float* b, float* x) const;

 private:
  /// Rows of blocks on one side of the diagonal.
  struct Triangle {
    std::vector<size_t> start{0};
    std::vector<int> column;
    std::unique_ptr<PackedBlock[]> block;
    void allocate();
  };
  void find_pattern(const int* start, const int* column, int levels);

  int n_;
  Rows rows_;  ///< of right sides and solutions
  std::vector<int> given_start_, given_column_;
  Triangle lower_, upper_;                  ///< L and D⁻¹U, without their unit diagonals
  std::vector<float> pivot_;                ///< D⁻¹, inverses of U's diagonal blocks, by columns
  float unit_ = 1;                          ///< of the fifth variable
  std::vector<float> work_;                 ///< eight numbers a row, of which five count
};

}  // namespace windhover::fluid
