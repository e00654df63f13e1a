// The command line.
#pragma once

namespace windhover::app {

/// Parses the command line and runs the command; returns the exit code.
int run_command(int argc, char** argv);

}  // namespace windhover::app
