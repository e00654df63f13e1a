// OpenCASCADE solids in the gmsh model that is being made.
#pragma once
#include <string>
#include <vector>

#include "geometry/airframe_options.h"
#include "geometry/rotor_options.h"

namespace windhover::mesher {

using geometry::Vec3;

/// Tags of volumes. A cylinder with ends at `from` and `to`, its rims rounded unless rounding is 0.
int add_cylinder(const Vec3& from, const Vec3& to, double radius, double rounding);

/// A cylinder about a rotor's axis between two places along it.
int add_cylinder(const geometry::RotorOptions& rotor, double radius, double from, double to, double rounding = 0);

int add_part(const geometry::PartOptions& part);

/// The tags of a volume's surfaces, which alone stay: volumes of air are made of these and of triangles that OpenCASCADE does
/// not know.
std::vector<int> keep_surfaces(int volume);

void name(int dimension, const std::vector<int>& tags, const std::string& text);

}  // namespace windhover::mesher
