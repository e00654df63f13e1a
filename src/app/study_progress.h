// What a study says while its runs are made: a line per run, and on a terminal a bar below them.
#pragma once
#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

namespace windhover::app {

/// "[####......]  4/10  step_deg=5  43 %  left 0:12:33"; `part` of all work is done; left_s < 0: not known yet.
std::string study_bar(size_t run, size_t runs, const std::string& name, double fraction, double part, double left_s);

/// The time left is estimated from the work done since the start, in any unit that makes runs comparable.
class StudyProgress {
 public:
  /// `work` of each run; `already` are those made earlier.
  StudyProgress(std::vector<double> work, const std::vector<bool>& already, std::FILE* out = stdout);

  void begin(size_t run, const std::string& name);
  /// `fraction` of the run that is being made, 0 to 1.
  void report(double fraction);
  void end(const std::string& outcome);

 private:
  using Clock = std::chrono::steady_clock;
  std::vector<double> work_;
  std::FILE* out_;
  bool terminal_;
  double all_ = 0, earlier_ = 0, done_ = 0, from_ = -1;
  size_t run_ = 0;
  std::string name_;
  Clock::time_point start_ = Clock::now(), last_ = Clock::time_point::min();
};

}  // namespace windhover::app
