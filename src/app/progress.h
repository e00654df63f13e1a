// What a run says while it runs: one line per step, rewritten in place on a terminal.
#pragma once
#include <mpi.h>

#include <chrono>
#include <cstdio>
#include <string>

namespace windhover::app {

struct StepReport {
  int step = 0;
  double time_s = 0;
  int newton = 0, krylov = 0;  ///< iterations of this step
  int coupling = 0;            ///< 0: there is no coupling
  std::string aircraft = {};   ///< attitude and thrust, where there are any
};

/// hours:minutes:seconds
std::string clock_text(double seconds);

/// `fraction` of the run is done after `elapsed_s`.
std::string progress_line(const StepReport& report, double fraction, double elapsed_s);

/// Reports on rank 0; the last step always, the others as far as there is time to read them. Without a terminal: plain
/// lines, at most two a second.
class Progress {
 public:
  Progress(double begin_s, double end_s, MPI_Comm comm, std::FILE* out = stdout);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void report(const StepReport& report);

 private:
  using Clock = std::chrono::steady_clock;
  double begin_s_, end_s_;
  std::FILE* out_;
  bool speaks_, terminal_;
  Clock::time_point start_ = Clock::now(), last_ = Clock::time_point::min();
  std::string pending_;  // the latest line, when it is not printed yet or not ended yet
};

}  // namespace windhover::app
