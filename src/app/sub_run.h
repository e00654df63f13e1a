// Runs of cases as processes of their own: what `windhover verify` and `windhover study` share.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace windhover::app {

/// The command line of `windhover VERB CASE --set ...`, by mpiexec on more than one rank.
std::vector<std::string> sub_command(const std::string& verb, const std::filesystem::path& case_file,
                                     const std::vector<std::string>& overrides, int ranks = 1);

/// The end of a log.
std::string last_lines(const std::filesystem::path& log, int count);

/// UserError unless the name can be that of a results folder.
void validate_run_name(const std::string& name, const std::string& place);

}  // namespace windhover::app
