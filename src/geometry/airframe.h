// The parts of an airframe, completed and checked before anything is meshed.
#pragma once
#include <filesystem>

#include "geometry/airframe_options.h"

namespace windhover::geometry {

/// Makes the name of the STEP file absolute.
void complete(AirframeOptions& airframe, const std::filesystem::path& folder);

/// UserError: parts without size or direction, with too much rounding, with mass and density, or mirrored onto themselves.
void validate(const AirframeOptions& airframe);

/// All parts, mirror images included.
std::vector<PartOptions> all_parts(const AirframeOptions& airframe);

}  // namespace windhover::geometry
