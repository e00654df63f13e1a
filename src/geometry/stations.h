// The stations of a blade, from lists or a CSV file.
#pragma once
#include <filesystem>

#include "geometry/rotor_options.h"
#include "geometry/spline.h"

namespace windhover::geometry {

/// Reads the station file into the lists and clears its name. UserError with file and line.
void read_stations(BladeOptions& blade, const std::filesystem::path& folder);

/// UserError when lists are missing, differ in length, or do not go outwards to the tip.
void validate_stations(const BladeOptions& blade);

/// What a blade is at each r/R; lengths over R, angles in radians with the collective.
struct Stations {
  explicit Stations(const BladeOptions& blade);
  Spline chord, pitch, sweep, offset;
  double root;
};

}  // namespace windhover::geometry
