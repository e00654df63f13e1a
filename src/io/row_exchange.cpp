#include "io/row_exchange.h"

#include <cassert>

#include "base/mpi_type.h"

namespace windhover::io {

RowExchange::RowExchange(std::span<const PetscInt> row, MPI_Comm comm) : n_items_(PetscInt(row.size())) {
  MPI_Allreduce(&n_items_, &n_total_, 1, MPIU_INT, MPI_SUM, comm);
  PetscLayout layout = nullptr;
  petsc(PetscLayoutCreateFromSizes(comm, PETSC_DECIDE, n_total_, 1, &layout));
  petsc(PetscLayoutGetLocalSize(layout, &n_rows_));
  petsc(PetscLayoutGetRange(layout, &first_row_, nullptr));
  petsc(PetscSFCreate(comm, sf_.out()));
  petsc(PetscSFSetGraphLayout(sf_, layout, n_items_, nullptr, PETSC_OWN_POINTER, row.data()));
  petsc(PetscLayoutDestroy(&layout));
}

std::vector<double> RowExchange::to_rows(std::span<const double> items, int columns) const {
  assert(items.size() == size_t(n_items_) * columns);
  const MpiType type(columns);
  std::vector<double> rows(size_t(n_rows_) * columns);
  petsc(PetscSFReduceBegin(sf_, type, items.data(), rows.data(), MPI_REPLACE));
  petsc(PetscSFReduceEnd(sf_, type, items.data(), rows.data(), MPI_REPLACE));
  return rows;
}

std::vector<double> RowExchange::to_items(std::span<const double> rows, int columns) const {
  assert(rows.size() == size_t(n_rows_) * columns);
  const MpiType type(columns);
  std::vector<double> items(size_t(n_items_) * columns);
  petsc(PetscSFBcastBegin(sf_, type, rows.data(), items.data(), MPI_REPLACE));
  petsc(PetscSFBcastEnd(sf_, type, rows.data(), items.data(), MPI_REPLACE));
  return items;
}

}  // namespace windhover::io
