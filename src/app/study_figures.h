// Figures of a study's runs, their errors, and which run is the cheapest that is accurate enough.
#pragma once
#include <filesystem>

#include "app/study_folder.h"

namespace windhover::app {

/// One figure of one run. A curve has no value, only an error.
struct StudyValue {
  std::optional<double> value, error;  ///< error: relative, or in the figure's unit when it has a tolerance
};

/// What is known of one run.
struct StudyRow {
  const StudyPoint* point = nullptr;
  std::optional<int> exit_code;
  std::string reason;
  StudyCost cost;
  std::vector<StudyValue> values;  ///< of each figure; empty for a run that did not come to its end

  bool is_finished() const { return exit_code == 0; }
};

/// Reads the runs that are there and measures them against the reference, if that one has finished. UserError: a table or
/// an entry that a finished run does not have.
std::vector<StudyRow> study_rows(const Study& study, const std::vector<StudyFolder>& folders);

/// All its errors are known and none is larger than allowed.
bool is_accurate(const StudyTable& table, const StudyRow& row);

/// "the cheapest setting within 1 % of the thrust is ..."
std::string study_conclusion(const Study& study, const std::vector<StudyRow>& rows);

}  // namespace windhover::app
