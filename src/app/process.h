// Other programs, run as processes of their own and never through a shell.
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace windhover::app {

/// Where a program's output goes; an empty path leaves it where ours goes. The same path twice is one file.
struct ProcessOutput {
  std::filesystem::path standard, error;
  bool append = false;
};

/// Runs the program to its end; returns its exit code, or 128 + signal. UserError when it cannot be started.
int run_process(const std::vector<std::string>& command, const ProcessOutput& output = {});

/// The same for long work: `watch` is called some times a second, and the first signal that it returns is handed on, to what
/// the program has started as well. A Ctrl-C on the terminal does not reach them: they are a process group of their own.
int run_process_watched(const std::vector<std::string>& command, const ProcessOutput& output, const std::function<int()>& watch);

/// The program that is running.
std::string own_path();

}  // namespace windhover::app
