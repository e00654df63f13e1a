#include "app/verify.h"

#include <algorithm>
#include <chrono>

#include "app/case.h"
#include "app/mesh_file.h"
#include "app/process.h"
#include "app/sub_run.h"
#include "base/errors.h"
#include "io/file.h"

namespace windhover::app {
namespace {

namespace fs = std::filesystem;

void run_logged(const std::vector<std::string>& command, const fs::path& log, const std::string& name) {
  const int code = run_process(command, {log, log});
  if (code != 0)
    throw UserError("run {} failed with exit code {}; its output, in {}, ends:{}", name, code, log.string(),
                    last_lines(log, 5));
}

/// The mesh when it is due, then the run.
void make_run(const VerifyRun& run, const fs::path& case_folder, const fs::path& results) {
  const fs::path case_file = case_folder / run.case_file, log = results / (run.name + ".log");
  const Case c = load_case(case_file, run.overrides);
  if (can_make_mesh(c) && mesh_is_due(c)) run_logged(sub_command("mesh", case_file, run.overrides), log, run.name);
  auto command = sub_command("run", case_file, run.overrides, run.ranks);
  command.insert(command.end(), {"--out", results / run.name});
  run_logged(command, log, run.name);
}

nlohmann::json run_check(const fs::path& program, const fs::path& results) {
  const fs::path printed = results / "check.json";
  const int code = run_process({WINDHOVER_PYTHON, program, results}, {printed, {}});
  if (code != 0) throw UserError("{}: failed with exit code {}", program.string(), code);
  auto values = nlohmann::json::parse(io::read_text(printed), nullptr, false);
  if (!values.is_object())
    throw UserError("{}: did not print a JSON object, see {}", program.string(), printed.string());
  return values;
}

const char* word(Verdict::Result result) {
  switch (result) {
    case Verdict::Result::holds: return "yes";
    case Verdict::Result::fails: return "NO";
    case Verdict::Result::missing: return "NO (not printed)";
    case Verdict::Result::skipped: return "skipped";
  }
  return "";
}

nlohmann::ordered_json record(const VerifyFigure& f, const Verdict& verdict) {
  nlohmann::ordered_json json = {{"name", f.name}, {"result", word(verdict.result)}};
  const auto put = [&](const char* name, const std::optional<double>& value) {
    if (value) json[name] = *value;
  };
  put("value", verdict.value);
  put("expected", f.expected);
  put("tolerance", f.tolerance);
  put("min", f.min);
  put("max", f.max);
  json["unit"] = f.unit;
  json["source"] = f.source;
  return json;
}

/// Prints the table and writes verify.json; true when nothing fails.
bool compare(const VerifyTable& table, const nlohmann::json& values, const std::vector<VerifyRun>& done,
             const fs::path& results) {
  size_t width = 6;
  for (const auto& figure : table.figures) width = std::max(width, figure.name.size() + figure.unit.size() + 3);
  fmt::print("{:<{}}  {:>12}  {:>12}  {:<24}  ok\n", "figure", width, "value", "expected", "allowed");
  bool good = true;
  nlohmann::ordered_json figures = nlohmann::json::array();
  for (const auto& figure : table.figures) {
    const Verdict verdict = judge(figure, values, done);
    good = good && (verdict.result == Verdict::Result::holds || verdict.result == Verdict::Result::skipped);
    const auto number = [](const std::optional<double>& v) { return v ? fmt::format("{:.6g}", *v) : "–"; };
    fmt::print("{:<{}}  {:>12}  {:>12}  {:<24}  {}\n",
               figure.unit.empty() ? figure.name : fmt::format("{} [{}]", figure.name, figure.unit), width,
               number(verdict.value), number(figure.expected), allowed_text(figure), word(verdict.result));
    figures.push_back(record(figure, verdict));
  }
  io::write_atomically(results / "verify.json",
                       nlohmann::ordered_json{{"holds", good}, {"figures", figures}}.dump(2) + "\n");
  return good;
}

}  // namespace

int verify(const fs::path& case_folder, bool quick) {
  const VerifyTable table = load_verify(case_folder / "verify.toml");
  const fs::path folder = fs::absolute(case_folder / "").lexically_normal().parent_path();
  const fs::path results = fs::path("results") / folder.filename();
  std::vector<VerifyRun> runs;
  for (const auto& run : table.runs) {
    std::error_code ignored;
    fs::remove_all(results / run.name, ignored);
    if (run.quick || !quick) runs.push_back(run);
  }
  if (runs.empty()) throw UserError("{}: no run is marked quick = true", (case_folder / "verify.toml").string());
  io::make_folder(results);
  for (const auto& run : runs) {
    fmt::print("run {} ... ", run.name);
    std::fflush(stdout);
    const auto start = std::chrono::steady_clock::now();
    make_run(run, folder, results);
    fmt::print("{:.1f} s\n", std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return compare(table, run_check(folder / table.check, results), runs, results) ? 0 : 1;
}

}  // namespace windhover::app
