// Every key of a trim: name, range and meaning. The defaults are those of the struct in trim_options.h.
#pragma once
#include "base/options.h"
#include "coupling/trim_options.h"

namespace windhover::coupling {

template <class V>
void declare(V& v, TrimOptions& o) {
  v.key("unknowns", o.unknowns,
        {.doc = "what is sought: motions of body.mount (rotation_z: pitch) and rotors of the body (their speeds); when "
                "missing: motions on springs, free rotation_x and rotation_z, and every rotor"});
  v.key("balance", o.balance,
        {.doc = "motions of body.mount along or about which the mean forces are to vanish, as many as unknowns; when "
                "missing: all that are free or on springs"});
  v.key("tolerance", o.tolerance,
        {.doc = "what may be left of the mean forces, over the weight, and of the mean moments, over the weight times "
                "the largest radius of gyration",
         .above = 0,
         .max = 0.5});
  v.key(
      "mean_tolerance", o.mean_tolerance,
      {.doc =
           "change of the means over the last third of a try's windows, on the same scale, from those over the third before, below "
           "which they count as settled; far from balance a quarter of what is left will do",
       .above = 0,
       .max = 0.5});
  v.key("window_revolutions", o.window_revolutions,
        {.doc = "length of a window, in revolutions at the mean speed of the rotors; when missing, 1", .above = 0});
  v.key("window_s", o.window_s, {.doc = "the same in seconds: for bodies without rotors", .above = 0});
  v.key("ramp_windows", o.ramp_windows,
        {.doc = "time in which body and rotors move smoothly to the next try, in windows", .above = 0});
  v.key("max_windows", o.max_windows, {.doc = "windows of a try whose means do not settle, at most", .min = 2});
  v.key("max_evaluations", o.max_evaluations, {.doc = "tries before the trim gives up", .min = 1});
  v.key("force_scale_N", o.force_scale_N, {.doc = "instead of the weight; needed where there is none", .min = 0});
  v.key("max_turn_deg", o.max_turn_deg, {.doc = "largest change of an angle from one try to the next", .above = 0});
  v.key("max_speed_change", o.max_speed_change,
        {.doc = "largest change of a rotor's speed, over its speed at the start", .above = 0, .max = 1});
}

}  // namespace windhover::coupling
