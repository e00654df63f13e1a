#include "app/session.h"

#include <csignal>
#include <cstdlib>
#include <sstream>
#include <vector>

#include "base/errors.h"
#include "base/petsc.h"

namespace windhover::app {
namespace {

bool in_mpi() {
  int begun = 0, ended = 0;
  MPI_Initialized(&begun);
  MPI_Finalized(&ended);
  return begun && !ended;
}

/// Prints on rank 0. mpiexec kills all ranks when the first fails, so they meet here before any of them ends.
void print_once(const std::string& message) {
  const bool open_mpi = !in_mpi() && started_by_mpiexec();
  if (open_mpi) MPI_Init(nullptr, nullptr);
  int rank = 0;
  if (in_mpi()) MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank == 0) fmt::print(stderr, "windhover: {}\n", message);
  if (in_mpi()) MPI_Barrier(MPI_COMM_WORLD);
  if (open_mpi) MPI_Finalize();
}

}  // namespace

bool started_by_mpiexec() { return std::getenv("OMPI_COMM_WORLD_SIZE") || std::getenv("PMI_SIZE"); }

Session::Session(const std::string& options) {
  std::signal(SIGXFSZ, SIG_IGN);  // a limit on file sizes is an error like a full disk, not the end
  std::vector<std::string> words = {"windhover", "-no_signal_handler"};
  std::istringstream stream(options);
  for (std::string word; stream >> word;) words.push_back(word);
  std::vector<char*> arguments;
  for (auto& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  int count = static_cast<int>(words.size());
  char** list = arguments.data();
  petsc(PetscInitialize(&count, &list, nullptr, nullptr));
}

Session::~Session() { PetscFinalize(); }

void reject_mpiexec(const char* command) {
  if (started_by_mpiexec()) throw UserError("`windhover {}` is one process: start it without mpiexec", command);
}

int guarded(const std::function<int()>& command) {
  try {
    return command();
  } catch (const UserError& error) {
    print_once(error.what());
    return 2;
  } catch (const SolverFailure& error) {
    print_once(error.what());
    return 3;
  } catch (const std::exception& error) {
    fmt::print(stderr, "windhover: internal error: {}\n", error.what());
    if (in_mpi()) MPI_Abort(MPI_COMM_WORLD, 1);
    return 1;
  }
}

}  // namespace windhover::app
