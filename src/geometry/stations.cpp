#include "geometry/stations.h"

#include <fstream>
#include <map>
#include <numbers>
#include <sstream>

#include "base/errors.h"
#include "base/options.h"

namespace windhover::geometry {
namespace {

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) {
    const size_t begin = cell.find_first_not_of(" \t\r"), end = cell.find_last_not_of(" \t\r");
    cells.push_back(begin == std::string::npos ? "" : cell.substr(begin, end - begin + 1));
  }
  return cells;
}

double number(const std::string& text, const std::string& place) {
  std::istringstream stream(text);
  double value = 0;
  if (!(stream >> value) || !stream.eof()) throw UserError("{}: \"{}\" is not a number", place, text);
  return value;
}

Spline spline(const BladeOptions& blade, const std::vector<double>& values) {
  return {blade.r_over_R, values.empty() ? std::vector<double>(blade.r_over_R.size(), 0) : values};
}

std::vector<double> pitch_angles(const BladeOptions& blade) {
  std::vector<double> pitch;
  for (const double beta : blade.beta_deg) pitch.push_back((beta + blade.collective_deg) * std::numbers::pi / 180);
  return pitch;
}

}  // namespace

void read_stations(BladeOptions& blade, const std::filesystem::path& folder) {
  if (blade.stations.empty()) return;
  if (!blade.r_over_R.empty()) throw UserError("give either stations = \"{}\" or r_over_R, not both", blade.stations);
  const std::string file = (folder / blade.stations).lexically_normal();
  std::ifstream stream(file);
  if (!stream) throw UserError("{}: cannot read this file of blade stations", file);
  const std::map<std::string, std::vector<double>*> lists = {{"r_over_R", &blade.r_over_R},
                                                            {"c_over_R", &blade.c_over_R},
                                                            {"beta_deg", &blade.beta_deg},
                                                            {"sweep_over_R", &blade.sweep_over_R},
                                                            {"offset_over_R", &blade.offset_over_R}};
  std::vector<std::vector<double>*> columns;
  int line_number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++line_number;
    if (line.empty() || line[0] == '#') continue;
    const std::string place = fmt::format("{}:{}", file, line_number);
    const auto cells = cells_of(line);
    if (columns.empty()) {
      for (const auto& name : cells) {
        if (!lists.contains(name)) {
          throw UserError("{}: unknown column \"{}\"{}", place, name,
                          suggestion(name, {"r_over_R", "c_over_R", "beta_deg", "sweep_over_R", "offset_over_R"}));
        }
        columns.push_back(lists.at(name));
      }
      continue;
    }
    if (cells.size() != columns.size()) throw UserError("{}: {} values for {} columns", place, cells.size(), columns.size());
    for (size_t i = 0; i < cells.size(); ++i) columns[i]->push_back(number(cells[i], place));
  }
  blade.stations.clear();
}

void validate_stations(const BladeOptions& blade) {
  const size_t n = blade.r_over_R.size();
  if (n < 2) throw UserError("r_over_R: at least two stations are needed, {} given", n);
  const auto check = [&](const char* name, const std::vector<double>& list, bool optional) {
    if (list.size() != n && !(optional && list.empty()))
      throw UserError("{}: {} values for {} stations", name, list.size(), n);
  };
  check("c_over_R", blade.c_over_R, false);
  check("beta_deg", blade.beta_deg, false);
  check("sweep_over_R", blade.sweep_over_R, true);
  check("offset_over_R", blade.offset_over_R, true);
  for (size_t i = 0; i < n; ++i) {
    if (blade.c_over_R[i] <= 0) throw UserError("c_over_R[{}] = {}: must be > 0", i, blade.c_over_R[i]);
    if (i > 0 && blade.r_over_R[i] <= blade.r_over_R[i - 1])
      throw UserError("r_over_R[{}] = {}: must be greater than {} before it", i, blade.r_over_R[i], blade.r_over_R[i - 1]);
  }
  if (blade.r_over_R.front() <= 0) throw UserError("r_over_R[0] = {}: must be > 0", blade.r_over_R.front());
  if (blade.r_over_R.back() != 1) throw UserError("r_over_R[{}] = {}: the last station must be the tip, 1", n - 1, blade.r_over_R.back());
}

Stations::Stations(const BladeOptions& blade)
    : chord(spline(blade, blade.c_over_R)),
      pitch(spline(blade, pitch_angles(blade))),
      sweep(spline(blade, blade.sweep_over_R)),
      offset(spline(blade, blade.offset_over_R)),
      root(blade.r_over_R.front()) {}

}  // namespace windhover::geometry
