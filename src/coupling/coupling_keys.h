// Every key of the coupling: name, range and meaning. The defaults are those of the struct in coupling_options.h.
#pragma once
#include "base/options.h"
#include "coupling/coupling_options.h"
#include "coupling/schemes.h"

namespace windhover::coupling {

template <class V>
void declare(V& v, CouplingOptions& o) {
  v.key("scheme", o.scheme,
        {.doc = "loose: the vehicle moves under the loads of the last step; loose-extrapolated: under loads "
                "extrapolated from the last two; strong: vehicle and air are iterated until they agree",
         .choices = scheme_names()});
  v.key("acceleration", o.acceleration,
        {.doc = "how a strong scheme iterates the loads; the keys that follow belong to strong schemes",
         .choices = acceleration_names()});
  v.key("tolerance", o.tolerance,
        {.doc = "change of the loads in one more iteration, relative to the loads", .above = 0, .max = 0.1});
  v.key("pose_tolerance", o.pose_tolerance,
        {.doc = "change of the pose in one more iteration, relative to the motion over the step",
         .above = 0,
         .max = 0.1});
  v.key("max_iterations", o.max_iterations, {.doc = "iterations before a step is refused and halved", .min = 1});
  v.key("newton_per_iteration", o.newton_per_iteration,
        {.doc = "Newton iterations of the flow in one coupling iteration, at most; dual time solves the flow in each", .min = 1});
  v.key("relaxation", o.relaxation,
        {.doc = "part of the change of the loads that is taken: always (constant), at first (aitken), where the "
                "accelerations know nothing better (anderson, iqn-ils)",
         .above = 0,
         .max = 1});
  v.key("columns", o.columns, {.doc = "differences that anderson and iqn-ils use, at most", .min = 1, .max = 50});
  v.key("reuse_steps", o.reuse_steps, {.doc = "earlier steps whose differences iqn-ils uses as well", .min = 0});
  v.key("filter", o.filter,
        {.doc = "iqn-ils leaves out a difference of which less than this part is new", .above = 0, .max = 1});
  v.key("force_scale_N", o.force_scale_N,
        {.doc = "changes of force are compared with at least this; 0: a thousandth of the weight, and round-off",
         .min = 0});
  v.key("moment_scale_Nm", o.moment_scale_Nm,
        {.doc = "the same for moments and rotors' torques; 0: that force times fluid.length_m", .min = 0});
  v.key("step_tolerance", o.step_tolerance,
        {.doc = "steps are chosen such that loads which are linear in time miss this part of them over a step, at most the "
                "step of [time] and never across a setpoint, a sample of the controller or output.average_from_s; 0: equal "
                "steps",
         .min = 0,
         .max = 1});
}

}  // namespace windhover::coupling
