// verify.toml, and the judgement of one figure.
#include <algorithm>
#include <cmath>
#include <limits>

#include "app/sub_run.h"
#include "app/verify.h"
#include "base/errors.h"
#include "io/options_documenter.h"
#include "io/options_reader.h"

namespace windhover::app {
namespace {

/// What a figure may be: [low, high].
std::pair<double, double> bounds(const VerifyFigure& f) {
  double low = f.min.value_or(-std::numeric_limits<double>::infinity());
  double high = f.max.value_or(std::numeric_limits<double>::infinity());
  if (f.tolerance) {
    low = std::max(low, *f.expected - *f.tolerance);
    high = std::min(high, *f.expected + *f.tolerance);
  }
  return {low, high};
}

void validate(const VerifyTable& table, const toml::table& file) {
  std::vector<std::string> names;
  for (const auto& run : table.runs) {
    validate_run_name(run.name, io::place(file, "run"));
    names.push_back(run.name);
  }
  for (size_t i = 0; i < table.figures.size(); ++i) {
    const auto& f = table.figures[i];
    const std::string place = io::place(file, fmt::format("figure[{}]", i));
    if (f.name.empty()) throw UserError("{}: a figure without a name", place);
    if (f.tolerance && !f.expected) throw UserError("{}: {}: tolerance needs expected", place, f.name);
    if (!f.tolerance && !f.min && !f.max)
      throw UserError("{}: {}: says nothing without tolerance, min or max", place, f.name);
    for (const auto& run : f.needs)
      if (std::find(names.begin(), names.end(), run) == names.end())
        throw UserError("{}: {}: needs the unknown run \"{}\"{}", place, f.name, run, suggestion(run, names));
  }
}

}  // namespace

template <class V>
void declare(V& v, VerifyRun& o) {
  v.key("name", o.name, {.doc = "name of the run and of its results folder"});
  v.key("case", o.case_file, {.doc = "case file"});
  v.key("set", o.overrides, {.doc = "overrides of the case"});
  v.key("ranks", o.ranks, {.doc = "MPI ranks", .min = 1});
  v.key("quick", o.quick, {.doc = "also part of --quick"});
}

template <class V>
void declare(V& v, VerifyFigure& o) {
  v.key("name", o.name, {.doc = "name in what check.py prints"});
  v.key("unit", o.unit, {.doc = "unit"});
  v.key("source", o.source, {.doc = "where the expected value comes from"});
  v.key("expected", o.expected, {.doc = "expected value"});
  v.key("tolerance", o.tolerance, {.doc = "largest deviation from it", .min = 0});
  v.key("min", o.min, {.doc = "smallest value"});
  v.key("max", o.max, {.doc = "largest value"});
  v.key("needs", o.needs, {.doc = "the runs it is computed from; when missing, all"});
}

template <class V>
void declare(V& v, VerifyTable& o) {
  v.key("check", o.check, {.doc = "Python program that prints the figures as a JSON object"});
  v.tables("run", o.runs, "The runs.");
  v.tables("figure", o.figures, "The figures.");
}

VerifyTable load_verify(const std::filesystem::path& file) {
  const toml::table root = io::read_toml(file);
  VerifyTable table;
  io::read_options(root, table);
  validate(table, root);
  return table;
}

std::string verify_documentation() {
  return "\n# Keys of verify.toml\n\nThe runs of `windhover verify` and the figures they should give.\n" +
         io::options_documentation<VerifyTable>();
}

Verdict judge(const VerifyFigure& figure, const nlohmann::json& values, const std::vector<VerifyRun>& done) {
  const auto is_done = [&](const std::string& name) {
    return std::any_of(done.begin(), done.end(), [&](const VerifyRun& run) { return run.name == name; });
  };
  if (!std::all_of(figure.needs.begin(), figure.needs.end(), is_done)) return {Verdict::Result::skipped, {}};
  const auto found = values.find(figure.name);
  if (found == values.end() || !found->is_number()) return {Verdict::Result::missing, {}};
  const double value = *found;
  const auto [low, high] = bounds(figure);
  return {value >= low && value <= high ? Verdict::Result::holds : Verdict::Result::fails, value};
}

std::string allowed_text(const VerifyFigure& figure) {
  const auto [low, high] = bounds(figure);
  if (std::isinf(low)) return fmt::format("≤ {:.6g}", high);
  if (std::isinf(high)) return fmt::format("≥ {:.6g}", low);
  return fmt::format("{:.6g} to {:.6g}", low, high);
}

}  // namespace windhover::app
