// A folder for one test's files, the same on every rank, removed afterwards.
#pragma once
#include <mpi.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "base/collective.h"

namespace windhover::testing {

class Scratch {
 public:
  Scratch() {
    static int count = 0;
    int id = getpid();
    MPI_Bcast(&id, 1, MPI_INT, 0, MPI_COMM_WORLD);
    path = std::filesystem::temp_directory_path() / fmt::format("windhover_test_{}_{}", id, count++);
    if (rank_of(MPI_COMM_WORLD) == 0) std::filesystem::create_directories(path);
    MPI_Barrier(MPI_COMM_WORLD);
  }
  ~Scratch() {
    MPI_Barrier(MPI_COMM_WORLD);
    std::error_code ignored;
    if (rank_of(MPI_COMM_WORLD) == 0) std::filesystem::remove_all(path, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  std::filesystem::path path;
};

}  // namespace windhover::testing
