// The gmsh model of airframe and rotors in a ball.
#pragma once
#include "geometry/rotor_options.h"

namespace windhover::mesher {

/// Meshes the air with the gmsh that is initialised. Volumes: each rotor's zone by its name, "outer". Surfaces: "airframe",
/// "<rotor>_blades", "<rotor>_hub", "<rotor>_slide" on both sides, "farfield". UserError: airframe and zones do not fit.
void mesh_aircraft(const geometry::GeometryOptions& geometry);

}  // namespace windhover::mesher
