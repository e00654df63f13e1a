#include "io/row_exchange.h"

#include <catch2/catch.hpp>

#include "base/collective.h"

using namespace windhover;

TEST_CASE("rows in any order go to their places and back", "[io]") {
  const int rank = rank_of(MPI_COMM_WORLD), size = size_of(MPI_COMM_WORLD);
  constexpr int per_rank = 101, columns = 3;
  // Rank r holds every size-th row, from the last to the first.
  std::vector<PetscInt> row(per_rank);
  std::vector<double> items;
  for (int i = 0; i < per_rank; ++i) {
    row[i] = (per_rank - 1 - i) * size + rank;
    for (int j = 0; j < columns; ++j) items.push_back(10.0 * row[i] + j);
  }
  const io::RowExchange exchange(row, MPI_COMM_WORLD);
  CHECK(exchange.n_total() == per_rank * size);
  const auto rows = exchange.to_rows(items, columns);
  REQUIRE(rows.size() == size_t(exchange.n_rows() * columns));
  for (PetscInt i = 0; i < exchange.n_rows(); ++i)
    for (int j = 0; j < columns; ++j) CHECK(rows[i * columns + j] == 10.0 * (exchange.first_row() + i) + j);
  CHECK(exchange.to_items(rows, columns) == items);
}
