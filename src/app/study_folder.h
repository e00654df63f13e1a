// The results folder of one run of a study: what is there, how it goes on, and what it cost.
#pragma once
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>

#include "app/study_table.h"

namespace windhover::app {

/// What a run did. Counts and seconds of steps are those of history.csv, hence of all attempts together.
struct StudyCost {
  long cells = 0, steps = 0, refused = 0;
  double newton = 0, krylov = 0, coupling = 0;  ///< of all steps
  double wall_s = 0, steps_wall_s = 0;          ///< all, and that of the steps
  double memory_GB = 0;                         ///< largest, over all ranks
  std::string revision;                         ///< of the program that ended it
};

/// A folder OUT/NAME. Each attempt at the run leaves its exit code and costs in attempts.json.
class StudyFolder {
 public:
  /// UserError when the folder holds a run with other settings.
  StudyFolder(const std::filesystem::path& out, const StudyPoint& point);

  const std::filesystem::path& path() const { return path_; }
  /// It has come to its end, or the solver gave up, which it would do again.
  bool is_done() const;
  /// A checkpoint is there to go on from.
  bool can_go_on() const;
  /// Exit code of the last attempt; none: there was no attempt.
  std::optional<int> exit_code() const;
  std::string reason() const;
  /// The part of the run that is done, 0 to 1; of a run at work as well.
  double fraction() const;
  StudyCost cost() const;

  /// Makes the mesh when it is due, then the run or what is left of it; output goes to log.txt. Returns the exit code.
  int make(const std::function<int()>& watch);

 private:
  void check_settings() const;
  void record(int code, const std::string& reason);
  void write_attempts() const;
  std::string reason_in_log(size_t begin) const;

  const StudyPoint& point_;
  std::filesystem::path path_;
  nlohmann::json attempts_ = nlohmann::json::array();
};

}  // namespace windhover::app
