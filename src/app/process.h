// Other programs, run as processes of their own and never through a shell.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace windhover::app {

/// Where a program's output goes; an empty path leaves it where ours goes. The same path twice is one file.
struct ProcessOutput {
  std::filesystem::path standard, error;
};

/// Runs the program to its end; returns its exit code, or 128 + signal. UserError when it cannot be started.
int run_process(const std::vector<std::string>& command, const ProcessOutput& output = {});

/// The program that is running.
std::string own_path();

}  // namespace windhover::app
