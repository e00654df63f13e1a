// Zones that turn must not reach through the surfaces on which they turn.
#pragma once
#include <span>
#include <vector>

#include "mesh/sliding/side.h"

namespace windhover::mesh {

/// Collective. `sides`: the inner and the outer one on each surface. UserError with the place, in lengths divided by `scale`:
/// a node of a zone, or of one that it carries, outside the surface on which it turns, or another zone's node inside it.
void check_zones(const Mesh& mesh, std::span<const RevolutionSurface> surfaces,
                 const std::vector<std::array<InterfaceSide, 2>>& sides, double scale);

}  // namespace windhover::mesh
