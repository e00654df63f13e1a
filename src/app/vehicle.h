// From a case to the vehicle that the air moves: body, motors, controller.
#pragma once
#include <toml++/toml.h>

#include "app/case.h"
#include "coupling/window.h"

namespace windhover::app {

/// The body moves under the air's loads, not as prescribed.
inline bool is_dynamic(const Case& c) { return c.body.kind == "dynamic"; }

/// Takes mass, centre of gravity and inertia from the parts of [airframe] and [[rotor]] when the case gives no mass, and the
/// inertia of each of the body's rotors that has none from the [[rotor]] of its name.
void complete_vehicle(Case& c);

coupling::VehicleModel vehicle_model(const Case& c);

/// The rotor of the body with this zone's name, or −1.
int rotor_of_zone(const Case& c, const ZoneOptions& zone);

/// The first zone that turns as time alone prescribes; null: none does.
const ZoneOptions* zone_turned_by_time(const Case& c);

/// UserError when there can be no such vehicle, or its rotors do not fit the zones that turn with them.
void validate_vehicle(const Case& c, const toml::table& file);

}  // namespace windhover::app
