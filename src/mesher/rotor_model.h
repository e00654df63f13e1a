// The gmsh model of rotors in a ball.
#pragma once
#include "geometry/rotor_options.h"

namespace windhover::mesher {

/// Meshes the air about the rotors with the gmsh that is initialised. Volumes: each rotor's zone by its name, "outer".
/// Surfaces: "<rotor>_blades", "<rotor>_hub", "<rotor>_slide" on both sides, "farfield".
void mesh_rotors(const geometry::GeometryOptions& geometry);

}  // namespace windhover::mesher
