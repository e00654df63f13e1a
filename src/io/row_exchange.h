// Items spread over the ranks in any order, such as cells, as the rows of a table that is split into one contiguous
// range of rows per rank.
#pragma once
#include <span>
#include <vector>

#include "base/petsc.h"

namespace windhover::io {

class RowExchange {
 public:
  /// `row[i]` is the row of this rank's item i; each of the rows 0 to n-1 belongs to one item of one rank. Collective.
  RowExchange(std::span<const PetscInt> row, MPI_Comm comm);

  PetscInt first_row() const { return first_row_; }
  PetscInt n_rows() const { return n_rows_; }  ///< of this rank's range
  PetscInt n_total() const { return n_total_; }

  /// Values of items, `columns` each, to values of this rank's rows, and back. Collective.
  std::vector<double> to_rows(std::span<const double> items, int columns) const;
  std::vector<double> to_items(std::span<const double> rows, int columns) const;

 private:
  SfHandle sf_;  // roots: rows, leaves: items
  PetscInt first_row_ = 0, n_rows_ = 0, n_total_ = 0, n_items_ = 0;
};

}  // namespace windhover::io
