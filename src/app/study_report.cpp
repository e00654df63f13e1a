#include "app/study_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "app/process.h"
#include "app/sub_run.h"
#include "io/file.h"

namespace windhover::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// A value, or null.
Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

Json cost_of(const StudyRow& row) {
  const StudyCost& cost = row.cost;
  const double per_step = 1.0 / double(std::max(1L, cost.steps));
  Json json = {
      {"cells", cost.cells}, {"ranks", row.point->ranks}, {"steps", cost.steps}, {"refused_steps", cost.refused}};
  json["newton_per_step"] = cost.newton * per_step;
  json["krylov_per_step"] = cost.krylov * per_step;
  json["coupling_per_step"] = cost.coupling * per_step;
  json["wall_s"] = cost.wall_s;
  json["steps_wall_s"] = cost.steps_wall_s;
  json["seconds_per_step"] = cost.steps_wall_s * per_step;
  json["memory_GB"] = cost.memory_GB;
  return json;
}

Json record(const Study& study, const StudyRow& row) {
  Json json = {{"run", row.point->name}};
  for (const auto& key : study.keys) json[key] = row.point->settings.at(key);
  json.update(cost_of(row));
  static const StudyValue none;
  for (size_t i = 0; i < study.table.figures.size(); ++i) {
    const StudyFigure& f = study.table.figures[i];
    const StudyValue& v = row.values.empty() ? none : row.values[i];
    if (f.take != "curve") json[f.name] = or_null(v.value);
    json[f.name + "_error"] = or_null(v.error);
  }
  json["accurate"] = row.is_finished() && is_accurate(study.table, row);
  json["exit_code"] = row.exit_code ? Json(*row.exit_code) : Json();
  json["reason"] = row.reason;
  json["revision"] = row.cost.revision;
  return json;
}

std::string cell(const Json& value) {
  if (value.is_null()) return "";
  if (!value.is_string()) return value.dump();
  std::string text = value;
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  for (size_t i = 0; (i = text.find('"', i)) != std::string::npos; i += 2) text.insert(i, 1, '"');
  return '"' + text + '"';
}

std::string csv_text(const std::vector<Json>& records) {
  std::string header, lines;
  for (const auto& [name, value] : records.front().items()) header += (header.empty() ? "" : ",") + cell(name);
  for (const auto& json : records) {
    std::string line;
    for (const auto& [name, value] : json.items()) line += (line.empty() ? "" : ",") + cell(value);
    lines += line + "\n";
  }
  return header + "\n" + lines;
}

}  // namespace

void write_study(const fs::path& out, const Study& study, const std::vector<StudyRow>& rows) {
  std::vector<Json> records;
  for (const StudyRow& row : rows) records.push_back(record(study, row));
  io::write_atomically(out / "study.csv", csv_text(records));

  Json figures = Json::array();
  for (const StudyFigure& f : study.table.figures)
    figures.push_back({{"name", f.name}, {"unit", f.unit}, {"allowed", f.allowed()}, {"relative", f.is_relative()}});
  for (size_t i = 0; i < rows.size(); ++i) records[i]["group"] = rows[i].point->group;
  std::vector<std::string> swept;
  for (const auto& list : study.table.sweep) swept.push_back(list.key);
  const Json json = {{"study", study.file.string()},
                     {"keys", study.keys},
                     {"swept", swept},
                     {"figures", figures},
                     {"reference", study.points[study.reference].name},
                     {"conclusion", study_conclusion(study, rows)},
                     {"runs", records}};
  io::write_atomically(out / "study.json", json.dump(2) + "\n");
}

std::string plot_study(const fs::path& out) {
  const fs::path log = out / "plot.log";
  const char* others = std::getenv("PYTHONPATH");
  setenv("PYTHONPATH", fmt::format("{}{}{}", WINDHOVER_PYTHON_PATH, others ? ":" : "", others ? others : "").c_str(),
         1);
  const int code = run_process({WINDHOVER_PYTHON, "-m", "windhover.study", out}, {log, log});
  std::string said = last_lines(log, 1);
  std::erase(said, '\n');
  std::error_code ignored;
  if (code == 0) fs::remove(log, ignored);
  return code == 0 ? "" : fmt::format("exit code {} of windhover.study: {}", code, said);
}

}  // namespace windhover::app
