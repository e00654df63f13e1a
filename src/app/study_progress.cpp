#include "app/study_progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <numeric>

#include "app/progress.h"

namespace windhover::app {

std::string study_bar(size_t run, size_t runs, const std::string& name, double fraction, double part, double left_s) {
  constexpr int width = 24;
  const int full = static_cast<int>(std::lround(width * part));
  return fmt::format("[{}{}] {}/{}  {}  {:.0f} %  left {}", std::string(full, '#'), std::string(width - full, '.'), run,
                     runs, name, 100 * fraction, left_s < 0 ? "?" : clock_text(left_s));
}

StudyProgress::StudyProgress(std::vector<double> work, const std::vector<bool>& already, std::FILE* out)
    : work_(std::move(work)), out_(out), terminal_(isatty(fileno(out))) {
  all_ = std::accumulate(work_.begin(), work_.end(), 0.0);
  for (size_t i = 0; i < work_.size(); ++i) earlier_ += already[i] ? work_[i] : 0;
}

void StudyProgress::begin(size_t run, const std::string& name) {
  run_ = run;
  name_ = name;
  from_ = -1;
  if (!terminal_) fmt::print(out_, "[{}/{}] {} ... ", run + 1, work_.size(), name);
  std::fflush(out_);
}

void StudyProgress::report(double fraction) {
  if (from_ < 0) from_ = fraction;  // a run that is continued has done that part already
  if (!terminal_) return;
  const auto now = Clock::now();
  if (last_ != Clock::time_point::min() && now - last_ < std::chrono::milliseconds(500)) return;
  last_ = now;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const double made = done_ + work_[run_] * (fraction - from_), there = earlier_ + done_ + work_[run_] * fraction;
  const double left = made > 0 ? elapsed * (all_ - there) / made : -1;
  fmt::print(out_, "\r\033[K{}", study_bar(run_ + 1, work_.size(), name_, fraction, all_ > 0 ? there / all_ : 1, left));
  std::fflush(out_);
}

void StudyProgress::end(const std::string& outcome) {
  done_ += work_[run_];
  if (terminal_) fmt::print(out_, "\r\033[K[{}/{}] {} ... ", run_ + 1, work_.size(), name_);
  fmt::print(out_, "{}\n", outcome);
  std::fflush(out_);
  last_ = Clock::time_point::min();
}

}  // namespace windhover::app
