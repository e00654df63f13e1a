// What a case's rotors and airframe imply for the rest of it.
#pragma once
#include <toml++/toml.h>

#include "app/case.h"

namespace windhover::app {

/// Gives every [[rotor]] with `like` the keys of that rotor which it does not have itself. UserError: no such rotor before it.
void copy_like_rotors(toml::table& file);

/// Their zones, boundary conditions, mesh file and limits of quality, where the case does not say otherwise.
void complete_rotors(Case& c);

/// UserError when they cannot be meshed.
void validate_rotors(const Case& c, const toml::table& file);

/// Without what complete_rotors added to the list of zones.
void remove_rotor_zones(Case& c);

}  // namespace windhover::app
