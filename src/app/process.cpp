#include "app/process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <thread>

#include "base/errors.h"

namespace windhover::app {
namespace {

/// The files that a new process finds open.
class FileActions {
 public:
  explicit FileActions(const ProcessOutput& output) : mode_(output.append ? O_APPEND : O_TRUNC) {
    posix_spawn_file_actions_init(&actions_);
    if (!output.standard.empty()) open(STDOUT_FILENO, output.standard);
    if (output.error.empty()) return;
    if (output.error == output.standard) {
      posix_spawn_file_actions_adddup2(&actions_, STDOUT_FILENO, STDERR_FILENO);
    } else {
      open(STDERR_FILENO, output.error);
    }
  }
  ~FileActions() { posix_spawn_file_actions_destroy(&actions_); }
  FileActions(const FileActions&) = delete;
  FileActions& operator=(const FileActions&) = delete;
  void close_input() { posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0); }
  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  void open(int descriptor, const std::filesystem::path& path) {
    posix_spawn_file_actions_addopen(&actions_, descriptor, path.c_str(), O_WRONLY | O_CREAT | mode_, 0666);
  }
  int mode_;
  posix_spawn_file_actions_t actions_;
};

pid_t start(const std::vector<std::string>& command, const FileActions& actions, const posix_spawnattr_t* attributes) {
  std::vector<char*> arguments;
  for (const auto& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  pid_t process = 0;
  const int error = posix_spawnp(&process, arguments[0], actions.get(), attributes, arguments.data(), environ);
  if (error != 0) throw UserError("{}: cannot start this program: {}", command[0], std::strerror(error));
  return process;
}

int exit_code(int status) { return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status); }

}  // namespace

int run_process(const std::vector<std::string>& command, const ProcessOutput& output) {
  const pid_t process = start(command, FileActions(output), nullptr);
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return exit_code(status);
}

int run_process_watched(const std::vector<std::string>& command, const ProcessOutput& output, const std::function<int()>& watch) {
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);  // to a group of its own, led by itself
  FileActions actions(output);
  actions.close_input();
  pid_t process = 0;
  try {
    process = start(command, actions, &attributes);
  } catch (...) {
    posix_spawnattr_destroy(&attributes);
    throw;
  }
  posix_spawnattr_destroy(&attributes);
  int status = 0, told = 0;
  while (waitpid(process, &status, WNOHANG) == 0) {
    const int signal = watch();
    if (signal != 0 && told == 0) kill(-process, told = signal);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return exit_code(status);
}

std::string own_path() { return std::filesystem::read_symlink("/proc/self/exe"); }

}  // namespace windhover::app
