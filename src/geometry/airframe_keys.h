// Every key of an airframe: name, range and meaning. The defaults are those of the structs in airframe_options.h.
#pragma once
#include "base/options.h"
#include "geometry/airframe_options.h"

namespace windhover::geometry {

template <class V>
void declare(V& v, PartOptions& o) {
  v.key("name", o.name, {.doc = "name in messages"});
  v.key("kind", o.kind, {.doc = "what solid it is", .choices = {"box", "ellipsoid", "cylinder", "capsule"}});
  v.when("kind", o.kind, "box", [&] {
    v.key("center_m", o.center_m, {.doc = "centre"});
    v.key("size_m", o.size_m, {.doc = "lengths of the edges, which are parallel to the axes", .min = 0});
    v.key("rounding_m", o.rounding_m, {.doc = "radius of the rounded edges", .min = 0});
  });
  v.when("kind", o.kind, "ellipsoid", [&] {
    v.key("center_m", o.center_m, {.doc = "centre"});
    v.key("radii_m", o.radii_m, {.doc = "half its axes, which are parallel to x, y, z", .min = 0});
  });
  v.when("kind", o.kind, "cylinder", [&] {
    v.key("from_m", o.from_m, {.doc = "centre of one end"});
    v.key("to_m", o.to_m, {.doc = "centre of the other end"});
    v.key("radius_m", o.radius_m, {.doc = "radius", .min = 0});
    v.key("rounding_m", o.rounding_m, {.doc = "radius of the rounded rims", .min = 0});
  });
  v.when("kind", o.kind, "capsule", [&] {
    v.key("from_m", o.from_m, {.doc = "centre of the half sphere at one end"});
    v.key("to_m", o.to_m, {.doc = "centre of the half sphere at the other end"});
    v.key("radius_m", o.radius_m, {.doc = "radius", .min = 0});
  });
  v.key("mirror", o.mirror,
        {.doc = "further parts like it: mirrored in the plane x = 0, in z = 0, or in both, which makes four of it",
         .choices = {"none", "x", "z", "xz"}});
  v.key("mass_kg", o.mass_kg, {.doc = "mass of each, spread evenly over all of its volume", .min = 0});
  v.key("density_kg_m3", o.density_kg_m3, {.doc = "density, in place of mass_kg", .min = 0});
}

template <class V>
void declare(V& v, AirframeOptions& o) {
  v.key("step", o.step, {.doc = "STEP file with one solid or several, relative to the case file"});
  v.key("size_m", o.size_m,
        {.doc = "the largest size of the mesh on the airframe; 0: 3 % of its largest extent", .min = 0});
  v.key("min_size_m", o.min_size_m, {.doc = "the smallest there; 0: an eighth of size_m", .min = 0});
  v.key("cells_per_turn", o.cells_per_turn, {.doc = "cells around a curved surface, a full turn of it", .min = 3});
  v.key("growth", o.growth, {.doc = "growth of sizes per distance", .above = 0, .max = 1});
  v.tables(
      "part", o.part,
      "The solids of which the airframe is made, together with those of the STEP file. They must touch and may overlap.");
}

}  // namespace windhover::geometry
