// The mesh of a case: made from its geometry, and judged.
#pragma once
#include "app/case.h"

namespace windhover::app {

/// The case says how its mesh is made.
bool can_make_mesh(const Case& c);

/// The mesh is missing, or older than the geometry it is made from, or made from another airframe or rotors.
bool mesh_is_due(const Case& c);

/// UserError when the mesh is missing, saying how to make it.
void require_mesh(const Case& c);

/// Runs gmsh on the case's geometry, or windhover-mesher on its airframe and rotors. UserError: a program missing, its errors, a parameter
/// that the geometry does not have.
void make_mesh(const Case& c);

/// Reads the mesh and prints its size and quality. UserError when that is below the case's limits.
void report_mesh(const Case& c);

}  // namespace windhover::app
