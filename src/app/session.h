// PETSc and MPI for the length of a command, and error messages that appear once.
#pragma once
#include <functional>
#include <string>

namespace windhover::app {

/// PETSc (and with it MPI) lives as long as this; `options` are PETSc options as on its command line.
class Session {
 public:
  explicit Session(const std::string& options);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
};

bool started_by_mpiexec();

/// UserError when started by mpiexec: for commands that are one process and start others.
void reject_mpiexec(const char* command);

/// Runs a command and turns what it throws into a message and an exit code (2: the user can mend it, 3: the solver
/// gave up). Errors of these two kinds are the same on every rank and are printed once; anything else is a bug, may
/// be one rank's alone, and ends all ranks.
int guarded(const std::function<int()>& command);

}  // namespace windhover::app
