// The time loop: from a validated case to results.
#pragma once
#include <mpi.h>

#include <optional>
#include <string>

#include "app/case.h"

namespace windhover::app {

struct RunOptions {
  std::string out;  ///< the results folder instead of output.directory; empty: as the case says
  bool restart = false;
  std::optional<int> steps;  ///< instead of the case's steps or end_s
};

/// Runs the case. Returns the exit code: 0, or 128 + signal when interrupted. Collective over PETSC_COMM_WORLD.
int run_simulation(const Case& c, const RunOptions& options);

/// The signal any rank has received, or 0. Collective.
int agreed_signal(MPI_Comm comm);

/// Everything but the steps: mesh, zones, memory and time estimate. Returns the exit code.
int check_simulation(const Case& c);

}  // namespace windhover::app
