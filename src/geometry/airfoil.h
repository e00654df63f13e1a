// The section of a blade: NACA four-digit or from a file of coordinates.
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

namespace windhover::geometry {

using Vec2 = Eigen::Vector2d;

/// Both sides from the leading edge (0, 0) to the trailing edge at x = 1, as fine polylines, in chords.
struct Airfoil {
  std::vector<Vec2> upper, lower;
};

/// "naca" and four digits, or a file. UserError: neither, or a file that is not an airfoil.
Airfoil make_airfoil(const std::string& name, double trailing_edge_thickness);

/// Between a (weight 0) and b (weight 1): points at equal fractions of the length of each side are weighted.
Airfoil blend(const Airfoil& a, const Airfoil& b, double weight);

/// Points of one side at fractions of its length.
std::vector<Vec2> points_at(const std::vector<Vec2>& side, const std::vector<double>& fractions);

double length_of(const std::vector<Vec2>& side);

}  // namespace windhover::geometry
