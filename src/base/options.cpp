#include "base/options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace windhover {

bool in_range(const Key& key, double value) {
  return std::isfinite(value) && value > key.above && value >= key.min && value <= key.max;
}

std::string range_text(const Key& key) {
  std::vector<std::string> bounds;
  if (std::isfinite(key.above)) bounds.push_back(fmt::format("> {}", key.above));
  if (std::isfinite(key.min)) bounds.push_back(fmt::format("≥ {}", key.min));
  if (std::isfinite(key.max)) bounds.push_back(fmt::format("≤ {}", key.max));
  return fmt::format("{}", fmt::join(bounds, ", "));
}

std::string quoted_list(const std::vector<std::string>& names) {
  std::string text;
  for (const auto& name : names) text += fmt::format("{}\"{}\"", text.empty() ? "" : ", ", name);
  return text;
}

namespace {

size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), size_t{0});
  for (size_t i = 1; i <= a.size(); ++i) {
    size_t diagonal = std::exchange(row[0], i);
    for (size_t j = 1; j <= b.size(); ++j) {
      const size_t replaced = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row.back();
}

}  // namespace

std::string nearest_name(const std::string& name, const std::vector<std::string>& valid) {
  std::string nearest;
  size_t best = std::max<size_t>(2, name.size() / 2) + 1;
  for (const auto& candidate : valid) {
    const size_t distance = edit_distance(name, candidate);
    if (distance < best && distance < candidate.size()) {
      best = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

std::string suggestion(const std::string& name, const std::vector<std::string>& valid) {
  const std::string nearest = nearest_name(name, valid);
  if (!nearest.empty()) return fmt::format(" (did you mean \"{}\"?)", nearest);
  return valid.empty() ? "" : fmt::format(" (valid: {})", quoted_list(valid));
}

}  // namespace windhover
