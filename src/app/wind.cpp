#include "app/wind.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace windhover::app {

Vec3 wind_change(const WindOptions& wind, double t) {
  Vec3 sum = Vec3::Zero();
  for (const WindChangeOptions& change : wind.change) {
    if (t < change.start_s) continue;
    const double part = change.duration_s > 0 ? std::min((t - change.start_s) / change.duration_s, 1.0) : 1.0;
    sum += (change.kind == "gust" ? (1 - std::cos(2 * std::numbers::pi * part)) / 2 : part) * change.velocity_m_s;
  }
  return sum;
}

Vec3 wind_jump(const Case& c) {
  const std::filesystem::path before = std::filesystem::path(c.time.start_from) / "case.toml";
  if (c.time.start_from.empty() || !exists(before))
    return Vec3::Zero();  // a restart does not need that folder any more
  return c.wind.velocity_m_s - load_case(before, {}).wind.velocity_m_s;
}

double next_wind_change(const WindOptions& wind, double t) {
  double next = std::numeric_limits<double>::infinity();
  for (const WindChangeOptions& change : wind.change)
    for (const double at : {change.start_s, change.start_s + change.duration_s})
      if (at > t) next = std::min(next, at);
  return next;
}

}  // namespace windhover::app
