#include "app/study_figures.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

#include "base/errors.h"
#include "io/csv.h"
#include "io/file.h"

namespace windhover::app {
namespace {

namespace fs = std::filesystem;

struct Curve {
  std::vector<double> time, value;

  /// Linear between its points, constant beyond them.
  double at(double t) const {
    const size_t after = std::upper_bound(time.begin(), time.end(), t) - time.begin();
    if (after == 0) return value.front();
    if (after == time.size()) return value.back();
    const double part = (t - time[after - 1]) / (time[after] - time[after - 1]);
    return value[after - 1] + part * (value[after] - value[after - 1]);
  }
};

/// The column over time from the figure's start on, where a row per step begins exactly; empty when the run ended before.
Curve read_curve(const StudyFigure& f, const fs::path& folder, const Case& c) {
  const io::CsvColumns table(folder / f.file);
  const Curve whole{table["time_s"], table[f.entry]};
  if (whole.time.empty()) return {};
  double from = f.from_s.value_or(whole.time.front());
  if (f.revolutions) from = std::max(whole.time.back() - *f.revolutions * *turn_seconds(c), whole.time.front());
  if (from > whole.time.back()) return {};
  Curve part;
  const bool by_step = f.file == "history.csv";
  if (by_step) part = {{from}, {whole.at(from)}};
  for (size_t i = 0; i < whole.time.size(); ++i) {
    if (by_step ? whole.time[i] <= from : whole.time[i] < from) continue;
    part.time.push_back(whole.time[i]);
    part.value.push_back(whole.value[i]);
  }
  return part;
}

double mean(const Curve& curve, bool over_time) {
  const auto& [t, v] = curve;
  const double length = t.back() - t.front();
  if (!over_time || length == 0) return std::accumulate(v.begin(), v.end(), 0.0) / double(v.size());
  double area = 0;
  for (size_t i = 1; i < t.size(); ++i) area += 0.5 * (v[i] + v[i - 1]) * (t[i] - t[i - 1]);
  return area / length;
}

double number_in_json(const fs::path& file, const std::string& entry) {
  const auto json = nlohmann::json::parse(io::read_text(file), nullptr, false);
  const nlohmann::json* node = &json;
  std::istringstream path(entry);
  for (std::string part; std::getline(path, part, '.');) {
    std::vector<std::string> names;
    for (const auto& item : node->items()) names.push_back(item.key());  // of a list: its indices
    if (!node->is_structured() || std::find(names.begin(), names.end(), part) == names.end())
      throw UserError("{}: has no entry \"{}\": \"{}\" is not there{}", file.string(), entry, part,
                      suggestion(part, names));
    node = node->is_array() ? &(*node)[std::stoul(part)] : &(*node)[part];
  }
  if (!node->is_number()) throw UserError("{}: \"{}\" is no number", file.string(), entry);
  return *node;
}

/// The number of a figure that is no curve.
std::optional<double> number(const StudyFigure& f, const fs::path& folder, const Case& c) {
  if (f.file == "summary.json") return number_in_json(folder / f.file, f.entry);
  const Curve curve = read_curve(f, folder, c);
  const auto& v = curve.value;
  if (v.empty()) return {};
  if (f.take == "last") return v.back();
  if (f.take == "max") return *std::max_element(v.begin(), v.end());
  if (f.take == "min") return *std::min_element(v.begin(), v.end());
  return mean(curve, f.file == "history.csv");
}

double size_of(const Curve& curve) {
  double size = 0;
  for (double v : curve.value) size = std::max(size, std::abs(v));
  return size;
}

/// The largest difference at the run's own times.
double difference(const Curve& run, const Curve& reference) {
  double largest = 0;
  for (size_t i = 0; i < run.time.size(); ++i) {
    const double d = std::abs(run.value[i] - reference.at(run.time[i]));
    largest = std::isnan(d) ? HUGE_VAL : std::max(largest, d);
  }
  return largest;
}

double scaled(const StudyFigure& f, double error, double size) {
  if (f.is_relative() && size == 0)
    throw UserError("figure {}: is 0 in the reference, which no error is relative to: give it a tolerance", f.name);
  return f.is_relative() ? error / std::abs(size) : error;
}

/// A figure of the reference, or what was expected of it.
struct Target {
  std::optional<double> value;
  Curve curve;
};

StudyValue measure(const StudyFigure& f, const fs::path& folder, const Case& c, const Target& target) {
  StudyValue v;
  if (f.take != "curve") {
    v.value = number(f, folder, c);
    if (v.value && target.value) v.error = scaled(f, std::abs(*v.value - *target.value), *target.value);
  } else if (const Curve curve = read_curve(f, folder, c); !curve.time.empty() && !target.curve.time.empty()) {
    v.error = scaled(f, difference(curve, target.curve), size_of(target.curve));
  }
  return v;
}

/// How a figure's limit reads: "1 % of thrust", "0.1 deg of pitch".
std::string text_of(const StudyFigure& f, double error) {
  return f.is_relative() ? fmt::format("{:.3g} % of {}", 100 * error, f.name)
                         : fmt::format("{:.3g}{}{} of {}", error, f.unit.empty() ? "" : " ", f.unit, f.name);
}

std::string errors_text(const StudyTable& table, const StudyRow& row) {
  std::string text;
  for (size_t i = 0; i < row.values.size(); ++i)
    if (row.values[i].error)
      text += fmt::format("{}{}", text.empty() ? "" : ", ", text_of(table.figures[i], *row.values[i].error));
  return text;
}

/// How far the run is from being accurate enough: its largest error over what is allowed.
double excess(const StudyTable& table, const StudyRow& row) {
  double largest = row.values.empty() ? HUGE_VAL : 0;
  for (size_t i = 0; i < row.values.size(); ++i) {
    const double error = row.values[i].error.value_or(HUGE_VAL);
    largest = std::max(largest, std::isnan(error) ? HUGE_VAL : error / table.figures[i].allowed());
  }
  return largest;
}

}  // namespace

std::vector<StudyRow> study_rows(const Study& study, const std::vector<StudyFolder>& folders) {
  std::vector<StudyRow> rows;
  for (size_t i = 0; i < folders.size(); ++i)
    rows.push_back({&study.points[i], folders[i].exit_code(), folders[i].reason(), folders[i].cost(), {}});
  const size_t r = study.reference;
  for (const StudyFigure& f : study.table.figures) {
    Target target{f.expected, {}};
    if (rows[r].is_finished() && f.take == "curve") target.curve = read_curve(f, folders[r].path(), study.points[r].c);
    if (rows[r].is_finished() && f.take != "curve" && !f.expected)
      target.value = number(f, folders[r].path(), study.points[r].c);
    for (size_t i = 0; i < rows.size(); ++i) {
      if (!rows[i].is_finished()) continue;
      rows[i].values.push_back(measure(f, folders[i].path(), study.points[i].c, target));
      if (!rows[i].values.back().value && f.take != "curve")
        rows[i].reason = fmt::format("ended before there was a figure {}", f.name);
    }
  }
  return rows;
}

bool is_accurate(const StudyTable& table, const StudyRow& row) { return excess(table, row) <= 1; }

std::string study_conclusion(const Study& study, const std::vector<StudyRow>& rows) {
  const StudyRow& reference = rows[study.reference];
  if (!reference.is_finished())
    return fmt::format("no conclusion: the reference {} has not finished", reference.point->name);
  const StudyRow *cheapest = nullptr, *nearest = nullptr;
  for (const StudyRow& row : rows) {
    if (!row.is_finished() || &row == &reference) continue;
    if (!nearest || excess(study.table, row) < excess(study.table, *nearest)) nearest = &row;
    if (is_accurate(study.table, row) && (!cheapest || row.cost.steps_wall_s < cheapest->cost.steps_wall_s))
      cheapest = &row;
  }
  std::string limits;
  for (const auto& f : study.table.figures) limits += (limits.empty() ? "" : ", ") + text_of(f, f.allowed());
  if (!nearest) return "no conclusion: no run besides the reference has finished";
  if (!cheapest)
    return fmt::format("no setting is within {}; nearest is {} ({})", limits, nearest->point->name,
                       errors_text(study.table, *nearest));
  const double ratio = reference.cost.steps_wall_s / cheapest->cost.steps_wall_s;
  return fmt::format("cheapest setting within {}: {} ({}), {:.3g} s of steps, {}", limits, cheapest->point->name,
                     errors_text(study.table, *cheapest), cheapest->cost.steps_wall_s,
                     ratio >= 1 ? fmt::format("{:.3g} times faster than the reference {} ({:.3g} s)", ratio,
                                              reference.point->name, reference.cost.steps_wall_s)
                                : fmt::format("{:.3g} times slower than the reference {} ({:.3g} s)", 1 / ratio,
                                              reference.point->name, reference.cost.steps_wall_s));
}

}  // namespace windhover::app
