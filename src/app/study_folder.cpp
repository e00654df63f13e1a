#include "app/study_folder.h"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <numeric>
#include <sstream>

#include "app/mesh_file.h"
#include "app/process.h"
#include "app/sub_run.h"
#include "base/errors.h"
#include "io/csv.h"
#include "io/file.h"

namespace windhover::app {
namespace {

namespace fs = std::filesystem;

constexpr int kGaveUp = 3;

/// The effective case without its first line, which names the program's version.
std::vector<std::string> keys_of(const std::string& effective) {
  std::vector<std::string> lines;
  std::istringstream text(effective);
  std::string line, section;
  for (std::getline(text, line); std::getline(text, line);) {
    if (line.starts_with('[')) section = line + " ";
    lines.push_back(line.starts_with('[') ? line : section + line);
  }
  return lines;
}

/// The first line in which two effective cases differ: there, and wanted.
std::pair<std::string, std::string> difference(const std::string& there, const std::string& wanted) {
  const auto a = keys_of(there), b = keys_of(wanted);
  const auto [x, y] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  return {x == a.end() ? "" : *x, y == b.end() ? "" : *y};
}

nlohmann::json read_json(const fs::path& file) {
  return fs::exists(file) ? nlohmann::json::parse(io::read_text(file), nullptr, false) : nlohmann::json();
}

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

}  // namespace

StudyFolder::StudyFolder(const fs::path& out, const StudyPoint& point) : point_(point), path_(out / point.name) {
  const auto attempts = read_json(path_ / "attempts.json");
  if (attempts.is_array()) attempts_ = attempts;
  check_settings();
}

void StudyFolder::check_settings() const {
  if (fs::exists(path_) && !fs::is_empty(path_) && !fs::exists(path_ / "attempts.json"))
    throw UserError("{}: holds something else than a run of a study: give another folder with --out", path_.string());
  const auto refuse = [&](const std::string& there, const std::string& wanted) {
    throw UserError(
        "{}: holds a run with other settings ({}; now {}): give another folder with --out, or remove that one",
        path_.string(), there.empty() ? "nothing" : there, wanted.empty() ? "nothing" : wanted);
  };
  if (!attempts_.empty() && attempts_.back().value("ranks", 1) != point_.ranks)
    refuse(fmt::format("ranks = {}", attempts_.back().value("ranks", 1)), std::to_string(point_.ranks));
  if (!fs::exists(path_ / "case.toml")) return;
  const auto [there, wanted] = difference(io::read_text(path_ / "case.toml"), effective_case(point_.c));
  if (there != wanted) refuse(there, wanted);
}

std::optional<int> StudyFolder::exit_code() const {
  if (attempts_.empty()) return {};
  return attempts_.back().value("exit_code", 1);
}

std::string StudyFolder::reason() const { return attempts_.empty() ? "" : attempts_.back().value("reason", ""); }

bool StudyFolder::is_done() const {
  return exit_code() == kGaveUp || (exit_code() == 0 && fs::exists(path_ / "summary.json"));
}

bool StudyFolder::can_go_on() const {
  if (!fs::exists(path_ / "case.toml") || !fs::is_directory(path_ / "checkpoint")) return false;
  const auto files = fs::directory_iterator(path_ / "checkpoint");
  return std::any_of(begin(files), end(files), [](const auto& entry) { return entry.path().extension() == ".h5"; });
}

double StudyFolder::fraction() const {
  std::ifstream history(path_ / "history.csv", std::ios::ate);
  if (!history) return 0;
  constexpr std::streamoff more_than_a_row = 8192;
  history.seekg(std::max(std::streamoff(0), std::streamoff(history.tellg()) - more_than_a_row));
  double time = 0;
  for (std::string line; std::getline(history, line) && !history.eof();)
    if (const size_t comma = line.find(','); comma != std::string::npos)
      time = std::strtod(line.c_str() + comma + 1, nullptr);
  const double end = end_seconds(point_.c);
  return end > 0 ? std::clamp(time / end, 0.0, 1.0) : 0;
}

StudyCost StudyFolder::cost() const {
  StudyCost cost;
  for (const auto& attempt : attempts_) {
    cost.wall_s += attempt.value("other_wall_s", 0.0);
    cost.refused += attempt.value("refused", 0L);
    cost.memory_GB = std::max(cost.memory_GB, attempt.value("memory_GB", 0.0));
    cost.cells = attempt.value("cells", cost.cells);
    cost.revision = attempt.value("revision", cost.revision);
  }
  if (!fs::exists(path_ / "history.csv")) return cost;
  const io::CsvColumns history(path_ / "history.csv");
  if (!history["step"].empty()) cost.steps = std::lround(history["step"].back());
  cost.newton = sum(history["newton"]);
  cost.krylov = sum(history["krylov"]);
  cost.coupling = sum(history["coupling_iterations"]);
  cost.steps_wall_s = sum(history["wall_s"]);
  cost.wall_s += cost.steps_wall_s;
  return cost;
}

/// Of a program that says why it failed, that; of any other its last line. The log of this attempt begins at `begin`.
std::string StudyFolder::reason_in_log(size_t begin) const {
  std::istringstream text(io::read_text(path_ / "log.txt").substr(begin));
  std::string reason;
  const std::string mark = "windhover: ";
  for (std::string line; std::getline(text, line);) {
    if (line.empty() || (reason.starts_with(mark) && !line.starts_with(mark))) continue;
    reason = line;
  }
  return reason.starts_with(mark) ? reason.substr(mark.size()) : reason;
}

void StudyFolder::record(int code, const std::string& reason) {
  nlohmann::json attempt = {{"exit_code", code}, {"reason", reason}, {"ranks", point_.ranks}};
  if (const auto summary = read_json(path_ / "summary.json"); summary.is_object()) {
    const auto& wall = summary["wall_s"];
    attempt["other_wall_s"] = wall["total"].get<double>() - wall["fluid"].get<double>();
    attempt["refused"] = summary["rejected_steps"];
    attempt["memory_GB"] = summary["memory_GB"]["peak"];
    attempt["cells"] = summary["cells"];
    attempt["revision"] = summary["revision"];
  }
  attempts_.push_back(attempt);
  write_attempts();
}

void StudyFolder::write_attempts() const { io::write_atomically(path_ / "attempts.json", attempts_.dump(2) + "\n"); }

int StudyFolder::make(const std::function<int()>& watch) {
  const bool go_on = can_go_on();
  std::error_code ignored;
  if (!go_on) {
    fs::remove_all(path_, ignored);
    attempts_ = nlohmann::json::array();
    io::make_folder(path_);
    write_attempts();
  }
  fs::remove(path_ / "summary.json", ignored);  // what is there afterwards is this attempt's
  const fs::path log = path_ / "log.txt";
  const size_t begin = fs::exists(log) ? fs::file_size(log) : 0;
  const ProcessOutput output{log, log, true};
  int code = 0;
  if (can_make_mesh(point_.c) && mesh_is_due(point_.c))
    code = run_process_watched(sub_command("mesh", point_.c.file, point_.overrides), output, watch);
  if (code == 0) {
    auto command = sub_command("run", point_.c.file, point_.overrides, point_.ranks);
    command.insert(command.end(), {"--out", path_});
    if (go_on) command.push_back("--restart");
    const bool by_mpiexec = point_.ranks > 1;
    code = run_process_watched(command, output, [&] { return by_mpiexec && watch() != 0 ? SIGUSR1 : watch(); });
  }
  constexpr int by_signal = 128;
  record(code, code == 0          ? ""
               : code > by_signal ? fmt::format("ended by signal {}", code - by_signal)
                                  : reason_in_log(begin));
  return code;
}

}  // namespace windhover::app
