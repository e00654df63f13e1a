// The keys of STUDY.toml, and what they make of them: runs.
#include "app/study_table.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "app/history.h"
#include "app/sub_run.h"
#include "base/errors.h"
#include "io/options_documenter.h"
#include "io/options_reader.h"

namespace windhover::app {

template <class V>
void declare(V& v, StudyRun& o) {
  v.key("name", o.name, {.doc = "first part of the names of its results folders"});
  v.key("set", o.overrides, {.doc = "overrides of the case, besides the study's"});
  v.key("ranks", o.ranks, {.doc = "MPI ranks; when missing, the study's", .min = 1});
}

template <class V>
void declare(V& v, StudyFigure& o) {
  v.key("name", o.name, {.doc = "name of its columns"});
  v.key("unit", o.unit, {.doc = "unit"});
  v.key("file", o.file, {.doc = "a table (.csv) or summary.json in the results folder of a run"});
  v.key("entry", o.entry, {.doc = "column of the table, or place in the file, such as \"averages.force_N.1\""});
  v.key(
      "take", o.take,
      {.doc =
           "what of a column: the mean over time (over rows, in a table without a row per step), the last, largest or "
           "smallest value, or its curve over time: the error is then the largest difference, relative to the "
           "reference's largest value",
       .choices = {"mean", "last", "max", "min", "curve"}});
  v.key("from_s", o.from_s, {.doc = "only from this time on", .min = 0});
  v.key("revolutions", o.revolutions,
        {.doc = "only the last revolutions, at the speed that step_deg refers to", .above = 0});
  v.key("expected", o.expected, {.doc = "what errors are measured from; when missing, the reference's value"});
  v.key("accuracy", o.accuracy,
        {.doc = "largest error wanted, relative; when it and tolerance are missing, 0.01", .above = 0});
  v.key("tolerance", o.tolerance, {.doc = "largest error wanted, in the figure's unit", .above = 0});
}

template <class V>
void declare(V& v, StudyTable& o) {
  v.key("case", o.case_file, {.doc = "case file, relative to this file"});
  v.key("set", o.overrides, {.doc = "overrides of the case in all runs"});
  v.key("ranks", o.ranks, {.doc = "MPI ranks", .min = 1});
  v.key("reference", o.reference,
        {.doc = "name of the run that errors and times are compared with; \"finest\": the one with the smallest step"});
  v.key("sweep", o.sweep, {.doc = "keys of the case, each with the list of its values: a run for every combination"});
  v.tables(
      "run", o.runs,
      "Runs with settings of their own, each made for every combination of the swept keys that it does not set itself.");
  v.tables("figure", o.figures, "What is compared.");
}

namespace {

namespace fs = std::filesystem;

using Settings = std::vector<std::pair<std::string, std::string>>;  // key and value

std::string key_of(const std::string& override_text) {
  std::string key = override_text.substr(0, override_text.find('='));
  std::replace(key.begin(), key.end(), '[', '.');
  std::erase_if(key, [](char c) { return c == ']' || c == ' ' || c == '"'; });
  return key;
}

std::vector<std::string> keys_of(const std::vector<std::string>& overrides) {
  std::vector<std::string> keys;
  for (const auto& text : overrides) keys.push_back(key_of(text));
  return keys;
}

bool contains(const std::vector<std::string>& list, const std::string& text) {
  return std::find(list.begin(), list.end(), text) != list.end();
}

void validate_figure(const StudyFigure& f, const std::string& place) {
  const bool column = fs::path(f.file).extension() == ".csv";
  const auto refuse = [&](const std::string& what) { throw UserError("{}: {}: {}", place, f.name, what); };
  if (f.name.empty()) throw UserError("{}: a figure without a name", place);
  if (f.entry.empty()) refuse("entry is needed: which column, or which place in the file");
  if (!column && f.file != "summary.json") refuse(fmt::format("file = \"{}\": must be a .csv or summary.json", f.file));
  if (f.from_s && f.revolutions) refuse("only one of from_s and revolutions");
  if (f.accuracy && f.tolerance) refuse("only one of accuracy and tolerance");
  if (!column && (f.from_s || f.revolutions || f.take != "mean")) refuse("take, from_s and revolutions are for tables");
  if (f.take == "curve" && f.expected) refuse("a curve has no expected number");
  if (f.expected == 0.0 && f.is_relative()) refuse("expected = 0 needs a tolerance: nothing is accurate relative to 0");
}

void validate(const Study& study, const toml::table& file) {
  std::set<std::string> names;
  for (size_t i = 0; i < study.table.figures.size(); ++i) {
    const StudyFigure& f = study.table.figures[i];
    const std::string place = io::place(file, fmt::format("figure[{}]", i));
    validate_figure(f, place);
    if (!names.insert(f.name).second) throw UserError("{}: {}: two figures of this name", place, f.name);
    for (const auto& point : study.points) {
      if (f.revolutions && !turn_seconds(point.c))
        throw UserError("{}: {}: revolutions = {}: needs something that turns steadily, as step_deg does", place,
                        f.name, *f.revolutions);
      const auto columns = history_columns(point.c);
      if (f.file == "history.csv" && !contains(columns, f.entry))
        throw UserError("{}: {}: entry = \"{}\": history.csv has no such column{}", place, f.name, f.entry,
                        suggestion(f.entry, columns));
    }
  }
}

/// Every combination of the lists, the last key changing fastest.
std::vector<Settings> combinations(const std::vector<ValueList>& lists) {
  std::vector<Settings> all = {{}};
  for (const auto& list : lists) {
    std::vector<Settings> longer;
    for (const auto& one : all)
      for (const auto& value : list.values) {
        longer.push_back(one);
        longer.back().emplace_back(list.key, value);
      }
    all = std::move(longer);
  }
  return all;
}

/// The last part of a key, or all of it where another swept key ends alike.
std::string short_key(const std::string& key, const std::vector<ValueList>& sweep) {
  const auto last = [](const std::string& k) { return k.substr(k.rfind('.') + 1); };
  const auto alike =
      std::count_if(sweep.begin(), sweep.end(), [&](const auto& list) { return last(list.key) == last(key); });
  return alike > 1 ? key : last(key);
}

/// The name of a folder that needs no quotes.
std::string point_name(const std::string& group, const Settings& settings, const std::vector<ValueList>& sweep) {
  std::string name = group;
  for (const auto& [key, value] : settings)
    name += fmt::format("{}{}={}", name.empty() ? "" : ",", short_key(key, sweep), value);
  std::erase_if(name, [](char c) { return c == '"' || c == '[' || c == ']' || c == ' '; });
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
}

std::vector<StudyPoint> make_points(const StudyTable& table, const std::vector<std::string>& common) {
  std::vector<StudyPoint> points;
  std::vector<StudyRun> runs = table.runs;
  if (runs.empty()) runs.emplace_back();
  for (const auto& run : runs) {
    const auto own = keys_of(run.overrides);
    std::vector<ValueList> swept = table.sweep;
    std::erase_if(swept, [&](const ValueList& list) { return contains(own, list.key); });
    for (const auto& settings : combinations(swept)) {
      StudyPoint& point = points.emplace_back();
      point.name = point_name(run.name, settings, table.sweep);
      point.group = run.name;
      point.ranks = run.ranks.value_or(table.ranks);
      point.overrides = common;
      for (const auto& [key, value] : settings) point.overrides.push_back(key + "=" + value);
      point.overrides.insert(point.overrides.end(), run.overrides.begin(), run.overrides.end());
    }
  }
  return points;
}

/// The value of a dotted key in the effective case; empty where the case does not have it.
std::string effective_value(const toml::table& effective, const std::string& key) {
  toml::node_view node(effective);
  std::istringstream path(key);
  for (std::string part; std::getline(path, part, '.');) {
    const bool index = node.is_array() && part.find_first_not_of("0123456789") == std::string::npos;
    node = index ? node[std::stoul(part)] : node[part];
  }
  if (const auto text = node.value_exact<std::string>()) return *text;
  return node ? io::value_text(*node.node()) : "";
}

void choose_reference(Study& study, const toml::table& file) {
  const std::string& wanted = study.table.reference;
  std::vector<std::string> names;
  for (const auto& point : study.points) names.push_back(point.name);
  const auto named = std::find(names.begin(), names.end(), wanted);
  study.reference = named - names.begin();
  if (named != names.end()) return;
  const std::string place = io::place(file, "reference");
  if (wanted != "finest")
    throw UserError("{}: reference = \"{}\": no run has this name{}", place, wanted, suggestion(wanted, names));
  double smallest = HUGE_VAL;
  for (const auto& point : study.points) smallest = std::min(smallest, step_seconds(point.c));
  std::vector<std::string> finest;
  for (size_t i = 0; i < names.size(); ++i) {
    if (step_seconds(study.points[i].c) > smallest * (1 + 1e-12)) continue;
    finest.push_back(names[i]);
    study.reference = i;
  }
  if (finest.size() > 1)
    throw UserError("{}: reference = \"finest\": the smallest step, {:.6g} s, is that of several runs; name one of {}",
                    place, smallest, quoted_list(finest));
}

}  // namespace

Study load_study(const fs::path& file, const std::vector<std::string>& overrides) {
  Study study;
  study.file = fs::absolute(file).lexically_normal();
  const toml::table root = io::read_toml(file);
  io::read_options(root, study.table);
  StudyTable& table = study.table;
  if (table.sweep.empty() && table.runs.empty())
    throw UserError("{}: nothing to run: [sweep] or [[run]] is needed", file.string());
  if (table.figures.empty())
    throw UserError("{}: nothing to compare: at least one [[figure]] is needed", file.string());
  for (const auto& run : table.runs) validate_run_name(run.name, io::place(root, "run"));
  std::vector<std::string> common = table.overrides;
  common.insert(common.end(), overrides.begin(), overrides.end());
  study.points = make_points(table, common);

  const auto add_key = [&](const std::string& key) {
    if (!contains(study.keys, key)) study.keys.push_back(key);
  };
  for (const auto& list : table.sweep) add_key(list.key);
  for (const auto& run : table.runs)
    for (const auto& key : keys_of(run.overrides)) add_key(key);
  std::set<std::string> names;
  for (auto& point : study.points) {
    if (!names.insert(point.name).second) throw UserError("{}: two runs are called \"{}\"", file.string(), point.name);
    try {
      point.c = load_case(study.file.parent_path() / table.case_file, point.overrides);
    } catch (const UserError& error) {
      throw UserError("{}: run {}: {}", file.string(), point.name, error.what());
    }
    const toml::table effective = toml::parse(effective_case(point.c));
    for (const auto& key : study.keys) point.settings[key] = effective_value(effective, key);
  }
  validate(study, root);
  choose_reference(study, root);
  return study;
}

std::string study_documentation() {
  return "\n# Keys of a study\n\nThe runs of `windhover study` and the figures compared ([studies.md](studies.md)).\n" +
         io::options_documentation<StudyTable>();
}

}  // namespace windhover::app
