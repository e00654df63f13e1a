// Every key of a controller: name, range and meaning. The defaults are those of the structs in control_options.h.
#pragma once
#include "base/options.h"
#include "control/control_options.h"
#include "control/controllers.h"

namespace windhover::control {

template <class V>
void declare(V& v, CascadeOptions& o) {
  v.key("position_gain_1_s", o.position_gain_1_s, {.doc = "velocity per missing distance along x, y, z"});
  v.key("max_speed_m_s", o.max_speed_m_s, {.doc = "fastest velocity that the position may ask for", .above = 0});
  v.key("velocity_gain_1_s", o.velocity_gain_1_s, {.doc = "acceleration per missing velocity along x, y, z"});
  v.key("velocity_integral_1_s2", o.velocity_integral_1_s2,
        {.doc = "growth of the acceleration per missing velocity along x, y, z"});
  v.key("max_tilt_deg", o.max_tilt_deg,
        {.doc = "largest angle of the thrust from the vertical", .above = 0, .max = 80});
  v.key("attitude_gain_1_s", o.attitude_gain_1_s, {.doc = "angular velocity per missing angle about body x, y, z"});
  v.key("max_rate_deg_s", o.max_rate_deg_s, {.doc = "fastest angular velocity that the attitude may ask for"});
  v.key("rate_gain_1_s", o.rate_gain_1_s,
        {.doc = "angular acceleration per missing angular velocity about body x, y, z"});
  v.key("rate_integral_1_s2", o.rate_integral_1_s2,
        {.doc = "growth of the angular acceleration per missing angular velocity about body x, y, z"});
  v.key("rate_derivative", o.rate_derivative,
        {.doc = "angular acceleration against the filtered angular acceleration about body x, y, z"});
  v.key("rate_filter_s", o.rate_filter_s, {.doc = "time constant of that filter", .above = 0});
  v.key("antiwindup_s", o.antiwindup_s, {.doc = "time in which integrators give way to a limit", .above = 0});
  v.key("torque_reserve", o.torque_reserve,
        {.doc = "part of the range of collective thrust at either end that is kept for torques", .min = 0, .max = 0.4});
}

template <class V>
void declare(V& v, WaypointOptions& o) {
  v.key("time_s", o.time_s, {.doc = "time from which it holds", .min = 0});
  v.key("position_m", o.position_m, {.doc = "where to be, inertial axes"});
  v.key("yaw_deg", o.yaw_deg, {.doc = "heading, clockwise seen from above"});
  v.key(
      "velocity_m_s", o.velocity_m_s,
      {.doc =
           "velocity to fly with, besides that for which a missing distance asks; for axes whose position gain is 0"});
}

template <class V>
void declare(V& v, ControllerOptions& o) {
  v.key("kind", o.kind,
        {.doc = "none: constant rotor speeds; cascade: position, velocity, attitude, rate, mixer",
         .choices = controller_names()});
  v.when("kind", o.kind, "none",
         [&] { v.key("speed_rad_s", o.speed_rad_s, {.doc = "commanded speed of each rotor, by its name"}); });
  v.when("kind", o.kind, "cascade", [&] {
    v.key("rate_hz", o.rate_hz, {.doc = "samples per second, held between; 0: continuous", .min = 0});
    v.section("cascade", o.cascade, "Gains of the cascade.");
    v.tables("plan", o.plan, "Where to be and when; without one, the origin.");
  });
}

}  // namespace windhover::control
