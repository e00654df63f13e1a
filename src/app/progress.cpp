#include "app/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

#include "app/session.h"
#include "base/collective.h"

namespace windhover::app {
std::string clock_text(double seconds) {
  const auto whole = static_cast<long long>(seconds + 0.5);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string progress_line(const StepReport& report, double fraction, double elapsed_s) {
  const std::string left = fraction > 0 ? clock_text(elapsed_s * (1 - fraction) / fraction) : "?";
  const std::string coupling = report.coupling > 0 ? fmt::format("  coupling {}", report.coupling) : "";
  const std::string aircraft = report.aircraft.empty() ? "" : "  " + report.aircraft;
  return fmt::format("step {:>6}  t {:<11.6g} s  {:>5.1f} %  left {}  newton {}  krylov {}{}{}", report.step,
                     report.time_s, 100 * fraction, left, report.newton, report.krylov, coupling, aircraft);
}

Progress::Progress(double begin_s, double end_s, MPI_Comm comm, std::FILE* out)
    : begin_s_(begin_s),
      end_s_(end_s),
      out_(out),
      speaks_(rank_of(comm) == 0),
      // mpiexec hands its ranks a terminal even when its own output goes into a file
      terminal_(isatty(fileno(out)) && !started_by_mpiexec()) {}

Progress::~Progress() {
  if (pending_.empty()) return;
  fmt::print(out_, "{}{}\n", terminal_ ? "\r\033[K" : "", pending_);
  std::fflush(out_);
}

void Progress::report(const StepReport& report) {
  if (!speaks_) return;
  const auto now = Clock::now();
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const double fraction =
      end_s_ > begin_s_ ? std::clamp((report.time_s - begin_s_) / (end_s_ - begin_s_), 0.0, 1.0) : 1.0;
  pending_ = progress_line(report, fraction, elapsed);
  const auto interval = std::chrono::milliseconds(terminal_ ? 50 : 500);
  if (last_ != Clock::time_point::min() && now - last_ < interval) return;
  last_ = now;
  fmt::print(out_, "{}{}{}", terminal_ ? "\r\033[K" : "", pending_, terminal_ ? "" : "\n");
  if (!terminal_) pending_.clear();
  std::fflush(out_);
}

}  // namespace windhover::app
