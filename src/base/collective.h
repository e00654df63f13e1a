// Errors that all ranks see: a UserError on one rank becomes the same UserError on every rank.
#pragma once
#include <mpi.h>

#include <string>

#include "base/errors.h"

namespace windhover {

int rank_of(MPI_Comm comm);
int size_of(MPI_Comm comm);

/// Collective: throws UserError with the message of the lowest rank that has one (an empty message is none).
void agree_on_error(const std::string& message, MPI_Comm comm);

/// Runs the body on every rank; a UserError of any of them is thrown on all. The body must not communicate.
template <class Body>
void collectively(MPI_Comm comm, Body&& body) {
  std::string message;
  try {
    body();
  } catch (const UserError& error) {
    message = error.what();
  }
  agree_on_error(message, comm);
}

/// As collectively, with the body on rank 0 only.
template <class Body>
void on_root(MPI_Comm comm, Body&& body) {
  collectively(comm, [&] {
    if (rank_of(comm) == 0) body();
  });
}

}  // namespace windhover
