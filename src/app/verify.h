// `windhover verify`: runs a case's table of runs, computes its figures with its check.py, and compares.
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace windhover::app {

/// One run of the case: [[run]] in verify.toml.
struct VerifyRun {
  std::string name, case_file = "case.toml";
  std::vector<std::string> overrides;
  int ranks = 1;
  bool quick = false;
};

/// One figure and what it should be: [[figure]] in verify.toml.
struct VerifyFigure {
  std::string name, unit, source;
  std::optional<double> expected, tolerance, min, max;
  std::vector<std::string> needs;  ///< the runs it is computed from; empty: all
};

struct VerifyTable {
  std::string check = "check.py";
  std::vector<VerifyRun> runs;
  std::vector<VerifyFigure> figures;
};

struct Verdict {
  enum class Result { holds, fails, missing, skipped };
  Result result = Result::skipped;
  std::optional<double> value;
};

VerifyTable load_verify(const std::filesystem::path& file);

/// The part of docs/case-file.md on verify.toml.
std::string verify_documentation();

/// Judges one figure by the values that check.py printed; `done` are the runs that were made.
Verdict judge(const VerifyFigure& figure, const nlohmann::json& values, const std::vector<VerifyRun>& done);

/// "9.8 to 10.2", "≥ 1.9", ...
std::string allowed_text(const VerifyFigure& figure);

/// Returns the exit code: 0 when every figure that was evaluated holds, otherwise 1.
int verify(const std::filesystem::path& case_folder, bool quick);

}  // namespace windhover::app
