#include "app/study.h"

#include <fcntl.h>
#include <sys/file.h>

#include <algorithm>
#include <cmath>

#include "app/study_progress.h"
#include "app/study_report.h"
#include "base/errors.h"
#include "base/interrupt.h"
#include "io/file.h"

namespace windhover::app {
namespace {

namespace fs = std::filesystem;

fs::path default_out(const fs::path& file) {
  const fs::path whole = fs::absolute(file).lexically_normal();
  const bool of_case = whole.filename() == "study.toml";
  return fs::path("results") / (of_case ? whole.parent_path().filename().string() + "-study" : whole.stem().string());
}

/// One study at a time in a folder, and none beside a run that a killed one left behind: the processes it starts hold the lock, too.
void lock(const fs::path& out) {
  const int file = open((out / "lock").c_str(), O_RDWR | O_CREAT, 0666);
  if (file < 0 || flock(file, LOCK_EX | LOCK_NB) != 0)
    throw UserError("{}: a study, or a run that it started, is still at work here", out.string());
}

int list_runs(const Study& study) {
  size_t width = 4;
  for (const auto& point : study.points) width = std::max(width, point.name.size());
  fmt::print("{:<{}}  {:>12}  {:>8}  {:>5}  mesh\n", "run", width, "step [s]", "steps", "ranks");
  for (const auto& point : study.points)
    fmt::print("{:<{}}  {:>12.6g}  {:>8}  {:>5}  {}{}\n", point.name, width, step_seconds(point.c), step_count(point.c),
               point.ranks, fs::proximate(point.c.mesh.file).string(),
               fs::exists(point.c.mesh.file) ? "" : " (not made yet)");
  fmt::print("reference: {}\n", study.points[study.reference].name);
  return 0;
}

/// A measure of the work that a run is, before it is made.
std::vector<double> works(const Study& study) {
  std::vector<double> work;
  for (const auto& point : study.points) work.push_back(step_count(point.c) * std::pow(point.c.mesh.refinement(), 3));
  return work;
}

std::string outcome(const StudyFolder& folder, int code) {
  const StudyCost cost = folder.cost();
  if (code != 0) return fmt::format("exit code {}: {}", code, folder.reason());
  return fmt::format("{} steps, {:.3g} s, of which steps {:.3g} s", cost.steps, cost.wall_s, cost.steps_wall_s);
}

/// Makes the runs that are not there. Returns the signal that ended it, or 0.
int make_runs(const fs::path& out, const Study& study, std::vector<StudyFolder>& folders) {
  std::vector<bool> already;
  for (const auto& folder : folders) already.push_back(folder.is_done());
  StudyProgress progress(works(study), already);
  for (size_t i = 0; i < folders.size() && interrupt_signal() == 0; ++i) {
    StudyFolder& folder = folders[i];
    if (already[i]) {
      fmt::print("[{}/{}] {}: is there\n", i + 1, folders.size(), study.points[i].name);
      continue;
    }
    progress.begin(i, study.points[i].name);
    const int code = folder.make([&] {
      progress.report(folder.fraction());
      return interrupt_signal();
    });
    progress.end(interrupt_signal() ? "interrupted" : outcome(folder, code));
    write_study(out, study, study_rows(study, folders));
  }
  return interrupt_signal();
}

int exit_code_of(const StudyRow& reference) {
  constexpr int user_error = 2, gave_up = 3;
  if (reference.is_finished()) return 0;
  return reference.exit_code == user_error ? user_error : gave_up;
}

}  // namespace

int study(const fs::path& file, const StudyOptions& options) {
  const Study study = load_study(file, options.overrides);
  if (options.check) return list_runs(study);
  const fs::path out = options.out.empty() ? default_out(file) : fs::path(options.out);
  io::make_folder(out);
  lock(out);
  std::vector<StudyFolder> folders;
  for (const auto& point : study.points) folders.emplace_back(out, point);
  catch_interrupts();
  if (const int signal = make_runs(out, study, folders)) {
    fmt::print("interrupted; the same command goes on from there\n");
    return 128 + signal;
  }
  const auto rows = study_rows(study, folders);
  write_study(out, study, rows);
  const std::string no_plot = plot_study(out);
  fmt::print("{}: study.csv{}\n", out.string(), no_plot.empty() ? ", study.png" : "; no plot: " + no_plot);
  fmt::print("{}\n", study_conclusion(study, rows));
  return exit_code_of(rows[study.reference]);
}

}  // namespace windhover::app
