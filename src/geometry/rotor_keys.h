// Every key of a rotor's geometry: name, range and meaning. The defaults are those of the structs in rotor_options.h.
#pragma once
#include "base/options.h"
#include "geometry/airframe_keys.h"
#include "geometry/rotor_options.h"

namespace windhover::geometry {

template <class V>
void declare(V& v, SectionOptions& o) {
  v.key("r_over_R", o.r_over_R, {.doc = "its place over R, on the blade", .min = 0, .max = 1});
  v.key("airfoil", o.airfoil, {.doc = "its airfoil, as blade.airfoil"});
}

template <class V>
void declare(V& v, BladeOptions& o) {
  v.key("count", o.count, {.doc = "number of blades, evenly around", .min = 0, .max = 12});
  v.key("radius_m", o.radius_m, {.doc = "radius R of the tip", .min = 0});
  v.key("stations", o.stations,
        {.doc = "CSV file with columns r_over_R, c_over_R, beta_deg and, if wanted, sweep_over_R, offset_over_R, "
                "in place of these lists; relative to the case file"});
  v.key("r_over_R", o.r_over_R, {.doc = "radii of the stations over R, from the root to 1", .min = 0, .max = 1});
  v.key("c_over_R", o.c_over_R, {.doc = "chords over R", .above = 0});
  v.key("beta_deg", o.beta_deg, {.doc = "angles of the chord to the plane of rotation"});
  v.key("sweep_over_R", o.sweep_over_R, {.doc = "distances of the quarter chord behind the pitch axis over R; missing: 0"});
  v.key("offset_over_R", o.offset_over_R, {.doc = "distances of the quarter chord above the pitch axis over R; missing: 0"});
  v.key("airfoil", o.airfoil,
        {.doc = "airfoil all along the span: naca and four digits, or a file of coordinates x y in chords, upper side "
                "from the trailing edge, then the lower side, relative to the case file; missing: naca0012"});
  v.key("trailing_edge_thickness", o.trailing_edge_thickness,
        {.doc = "thickness of the trailing edge in chords; 0: sharp", .min = 0, .max = 0.1});
  v.key("tip", o.tip, {.doc = "how tip and root end", .choices = {"rounded", "flat"}});
  v.key("collective_deg", o.collective_deg, {.doc = "angle added to all of beta_deg"});
  v.key("precone_deg", o.precone_deg, {.doc = "angle of the blades above the plane of rotation", .min = -45, .max = 45});
  v.tables("section", o.section,
           "Airfoils that change along the span, in place of blade.airfoil, from the root outwards. Between two sections "
           "the airfoil is blended linearly in r/R; within the first and beyond the last it stays.");
}

template <class V>
void declare(V& v, HubOptions& o) {
  v.key("radius_m", o.radius_m, {.doc = "radius; 0: no hub", .min = 0});
  v.key("from_m", o.from_m, {.doc = "place of its lower end along the axis"});
  v.key("to_m", o.to_m, {.doc = "place of its upper end"});
  v.key("rounding_m", o.rounding_m, {.doc = "radius of its rounded edges", .min = 0});
}

template <class V>
void declare(V& v, RotorZoneOptions& o) {
  v.key("radius_m", o.radius_m, {.doc = "radius of the cylinder that turns with the rotor", .min = 0});
  v.key("from_m", o.from_m, {.doc = "place of its lower disc along the axis"});
  v.key("to_m", o.to_m, {.doc = "place of its upper disc"});
}

template <class V>
void declare(V& v, RotorSizeOptions& o) {
  v.key("leading_edge", o.leading_edge, {.doc = "along the section's contour at the leading edge, in chords", .above = 0});
  v.key("trailing_edge", o.trailing_edge, {.doc = "there at the trailing edge, in chords", .above = 0});
  v.key("chord", o.chord, {.doc = "the largest there, in chords", .above = 0});
  v.key("smallest_m", o.smallest_m, {.doc = "the smallest there: short chords have fewer cells; 0: none", .min = 0});
  v.key("root_m", o.root_m, {.doc = "along the span at the root; 0: as span_m", .min = 0});
  v.key("tip_m", o.tip_m, {.doc = "along the span at the tip; 0: as span_m", .min = 0});
  v.key("span_m", o.span_m, {.doc = "the largest along the span; 0: 4 % of the blade's radius", .min = 0});
  v.key("hub_m", o.hub_m, {.doc = "on the hub; 0: a third of its radius", .min = 0});
  v.key("interface_m", o.interface_m, {.doc = "on the zone's surface; 0: 12 % of the blade's radius", .min = 0});
  v.key("zone_m", o.zone_m, {.doc = "the largest within the zone; 0: as interface_m", .min = 0});
  v.key("wake_m", o.wake_m, {.doc = "in the wake, a cylinder below the zone; 0: nothing special", .min = 0});
  v.key("wake_length_m", o.wake_length_m, {.doc = "length of the wake; 0: the blade's radius", .min = 0});
  v.key("growth", o.growth, {.doc = "growth of sizes per distance", .above = 0, .max = 1});
}

template <class V>
void declare(V& v, RotorOptions& o) {
  v.key("name", o.name, {.doc = "name of the rotor and of its zone"});
  v.key("like", o.like, {.doc = "name of another rotor, from which all keys come that are not given here"});
  v.key("center_m", o.center_m, {.doc = "the hub's centre: lengths along the axis count from it"});
  v.key("axis", o.axis, {.doc = "axis of rotation, towards the thrust; any length"});
  v.key("direction", o.direction,
        {.doc = "how the rotor turns, seen from the side of the thrust", .choices = {"counter_clockwise", "clockwise"}});
  v.key("rpm", o.rpm, {.doc = "turns per minute", .min = 0});
  v.key("angle_deg", o.angle_deg, {.doc = "right-handed angle of the first blade at the start"});
  v.key("mass_kg", o.mass_kg, {.doc = "mass of hub and blades", .min = 0});
  v.section("blade", o.blade, "The blades: sections at stations, joined by cubic splines, the pitch axis at a quarter chord.");
  v.section("hub", o.hub, "The hub: a cylinder with rounded edges, not joined to the blades.");
  v.section("zone", o.zone, "The cylinder that turns with the rotor.");
  v.section("size", o.size, "Sizes of the mesh at mesh.refine = 1.");
}

template <class V>
void declare(V& v, FarfieldOptions& o) {
  v.key("center_m", o.center_m, {.doc = "centre of the ball around everything"});
  v.key("radius_m", o.radius_m, {.doc = "its radius", .min = 0});
  v.key("size_m", o.size_m, {.doc = "size there; 0: a fifth of the radius", .min = 0});
}

template <class V>
void declare(V& v, GeometryOptions& o) {
  v.key("refine", o.refine, {.doc = "all sizes are divided by it", .above = 0});
  v.section("farfield", o.farfield, "The ball around everything.");
  v.section("airframe", o.airframe, "The airframe.");
  v.tables("rotor", o.rotor, "The rotors.");
}

}  // namespace windhover::geometry
