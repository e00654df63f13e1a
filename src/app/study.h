// `windhover study`: a table of runs, their errors and costs, and the cheapest setting that is accurate enough.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "app/study_table.h"

namespace windhover::app {

struct StudyOptions {
  std::string out;  ///< folder of the results; empty: results/<name of the study>
  std::vector<std::string> overrides;
  bool check = false;  ///< only read everything and list the runs
};

/// Makes the runs that are not there yet, one after the other, each as a process of its own. Returns the exit code: 0, 128 + signal when
/// interrupted, otherwise that the reference failed with (2 when the user can mend it, 3).
int study(const std::filesystem::path& file, const StudyOptions& options);

}  // namespace windhover::app
