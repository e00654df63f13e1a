// STUDY.toml: which runs are made, and which figures of them are compared.
#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/case.h"
#include "base/options.h"

namespace windhover::app {

/// [[run]]: made for every combination of the swept keys that it does not set itself.
struct StudyRun {
  std::string name;
  std::vector<std::string> overrides;
  std::optional<int> ranks;
};

/// [[figure]]: a number of each run, or a curve over time, that should agree with the reference's.
struct StudyFigure {
  std::string name, unit, file = "history.csv", entry, take = "mean";
  std::optional<double> from_s, revolutions, expected, accuracy, tolerance;

  /// The largest error that is allowed: of its unit, or a part of the reference's value.
  double allowed() const { return tolerance ? *tolerance : accuracy.value_or(0.01); }
  bool is_relative() const { return !tolerance; }
};

struct StudyTable {
  std::string case_file = "case.toml", reference = "finest";
  std::vector<std::string> overrides;
  int ranks = 1;
  std::vector<ValueList> sweep;
  std::vector<StudyRun> runs;
  std::vector<StudyFigure> figures;
};

/// One run of the study, its case read and validated.
struct StudyPoint {
  std::string name, group;  ///< group: the name of its [[run]]
  std::vector<std::string> overrides;
  std::map<std::string, std::string> settings;  ///< the values of the keys in which runs differ, by key
  int ranks = 1;
  Case c;
};

struct Study {
  std::filesystem::path file;
  StudyTable table;
  std::vector<std::string> keys;  ///< those in which runs differ, in the order of the file
  std::vector<StudyPoint> points;
  size_t reference = 0;  ///< which point
};

/// Reads the study and the case of every run; `overrides` come after the study's own `set` and before what each run sets.
/// UserError for anything wrong in any of them.
Study load_study(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

/// The part of docs/case-file.md on studies.
std::string study_documentation();

}  // namespace windhover::app
