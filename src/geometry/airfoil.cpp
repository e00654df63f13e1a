#include "geometry/airfoil.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <regex>
#include <sstream>

#include "base/errors.h"
#include "geometry/spline.h"

namespace windhover::geometry {
namespace {

constexpr int kSamples = 400;  ///< segments of a side

/// Closely spaced at both ends.
double cosine(int i) { return (1 - std::cos(std::numbers::pi * i / kSamples)) / 2; }

Airfoil naca(double camber, double place, double thickness) {
  Airfoil a;
  for (int i = 0; i <= kSamples; ++i) {
    const double x = cosine(i);
    const double half = 5 * thickness *
                        (0.2969 * std::sqrt(x) - 0.1260 * x - 0.3516 * x * x + 0.2843 * x * x * x - 0.1015 * x * x * x * x);
    const double p = x < place ? place : 1 - place;
    const double y = camber == 0 ? 0 : camber / (p * p) * (x < place ? 2 * place * x - x * x : 1 - 2 * place + 2 * place * x - x * x);
    const double slope = camber == 0 ? 0 : 2 * camber / (p * p) * (place - x);
    const Vec2 normal = Vec2(-slope, 1) / std::hypot(slope, 1);
    a.upper.push_back(Vec2(x, y) + half * normal);
    a.lower.push_back(Vec2(x, y) - half * normal);
  }
  return a;
}

std::vector<double> lengths(const std::vector<Vec2>& points) {
  std::vector<double> s{0};
  for (size_t i = 1; i < points.size(); ++i) s.push_back(s.back() + (points[i] - points[i - 1]).norm());
  return s;
}

/// A line of the file that does not hold two numbers, such as a title, is skipped.
std::vector<Vec2> read_points(const std::string& file) {
  std::ifstream stream(file);
  if (!stream) throw UserError("{}: airfoil: neither naca and four digits nor a file that can be read", file);
  std::vector<Vec2> points;
  for (std::string line; std::getline(stream, line);) {
    std::istringstream numbers(line);
    Vec2 p;
    if (numbers >> p.x() >> p.y() && (points.empty() || p != points.back())) points.push_back(p);
  }
  return points;
}

Airfoil read_airfoil(const std::string& file) {
  const std::vector<Vec2> points = read_points(file);
  const auto nose = std::min_element(points.begin(), points.end(), [](const Vec2& a, const Vec2& b) { return a.x() < b.x(); });
  if (nose - points.begin() < 5 || points.end() - nose < 6)
    throw UserError("{}: expected at least 5 points on each side, from the trailing edge over the upper side to the "
                    "leading edge and back along the lower side", file);
  const std::vector<double> s = lengths(points);
  std::vector<double> x, y;
  for (const Vec2& p : points) x.push_back(p.x()), y.push_back(p.y());
  const Spline spline_x(s, x), spline_y(s, y);
  const double middle = s[nose - points.begin()];
  Airfoil a;
  for (int i = 0; i <= kSamples; ++i) {
    const double up = middle * (1 - cosine(i)), low = middle + (s.back() - middle) * cosine(i);
    a.upper.emplace_back(spline_x(up), spline_y(up));
    a.lower.emplace_back(spline_x(low), spline_y(low));
  }
  const Vec2 origin = *nose;
  const double chord = ((a.upper.back() + a.lower.back()) / 2 - origin).x();
  if (!(chord > 0) || a.upper[kSamples / 2].y() <= a.lower[kSamples / 2].y())
    throw UserError("{}: the first half of the points must be the upper side", file);
  for (auto* side : {&a.upper, &a.lower})
    for (Vec2& p : *side) p = (p - origin) / chord;
  return a;
}

/// Opens the trailing edge by a wedge from the leading edge.
void set_thickness(Airfoil& a, double thickness) {
  const Vec2 middle = (a.upper.back() + a.lower.back()) / 2, half(0, thickness / 2);
  const Vec2 up = middle + half - a.upper.back(), down = middle - half - a.lower.back();
  for (Vec2& p : a.upper) p += p.x() * up;
  for (Vec2& p : a.lower) p += p.x() * down;
}

}  // namespace

Airfoil make_airfoil(const std::string& name, double trailing_edge_thickness) {
  std::smatch digits;
  Airfoil a;
  if (std::regex_match(name, digits, std::regex("naca([0-9])([0-9])([0-9][0-9])"))) {
    const double thickness = std::stod(digits[3]) / 100, camber = std::stod(digits[1]) / 100;
    const double place = std::stod(digits[2]) / 10;
    if (thickness == 0) throw UserError("airfoil \"{}\": has no thickness", name);
    if ((camber == 0) != (place == 0)) throw UserError("airfoil \"{}\": camber and its place must both be given", name);
    a = naca(camber, place, thickness);
  } else {
    a = read_airfoil(name);
  }
  set_thickness(a, trailing_edge_thickness);
  for (size_t i = 1; i + 1 < a.upper.size(); ++i)
    if (a.upper[i].y() <= a.lower[i].y())
      throw UserError("airfoil \"{}\": its sides cross at x = {:.3g}", name, a.upper[i].x());
  return a;
}

Airfoil blend(const Airfoil& a, const Airfoil& b, double weight) {
  if (weight == 0) return a;
  if (weight == 1) return b;
  std::vector<double> fractions;
  for (int i = 0; i <= kSamples; ++i) fractions.push_back(cosine(i));
  const auto between = [&](const std::vector<Vec2>& from, const std::vector<Vec2>& to) {
    std::vector<Vec2> points = points_at(from, fractions);
    const std::vector<Vec2> others = points_at(to, fractions);
    for (size_t i = 0; i < points.size(); ++i) points[i] += weight * (others[i] - points[i]);
    return points;
  };
  return {between(a.upper, b.upper), between(a.lower, b.lower)};
}

std::vector<Vec2> points_at(const std::vector<Vec2>& side, const std::vector<double>& fractions) {
  const std::vector<double> s = lengths(side);
  std::vector<Vec2> points;
  for (const double f : fractions) {
    const double at = f * s.back();
    const size_t i = std::clamp<size_t>(std::upper_bound(s.begin(), s.end(), at) - s.begin(), 1, s.size() - 1);
    points.push_back(side[i - 1] + (at - s[i - 1]) / (s[i] - s[i - 1]) * (side[i] - side[i - 1]));
  }
  return points;
}

double length_of(const std::vector<Vec2>& side) { return lengths(side).back(); }

}  // namespace windhover::geometry
