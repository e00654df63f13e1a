// Rotors as a case gives them: completed and checked before anything is meshed.
#pragma once
#include <filesystem>

#include "geometry/rotor_options.h"

namespace windhover::geometry {

/// Reads the station file, makes file names absolute, fills in sizes that follow from others.
void complete(RotorOptions& rotor, const std::filesystem::path& folder);

/// UserError: values that do not fit together, a blade or hub that pokes through the zone, a blade in the hub, zones that
/// overlap or leave the ball.
void validate(const GeometryOptions& geometry);

/// Distance inside a cylinder about the rotor's axis, to its surface; negative outside, where it may be less far.
double depth(const RotorOptions& rotor, double radius, double from, double to, const Vec3& point);

}  // namespace windhover::geometry
