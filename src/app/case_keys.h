// Every key of a case file: name, range and meaning. The defaults are those of the structs in case.h.
#pragma once
#include "app/case.h"
#include "base/options.h"
#include "body/vehicle_keys.h"
#include "control/control_keys.h"
#include "coupling/coupling_keys.h"
#include "coupling/trim_keys.h"
#include "geometry/rotor_keys.h"

namespace windhover::app {

template <class V>
void declare(V& v, MeshOptions& o) {
  v.key("file", o.file,
        {.doc = "gmsh mesh, relative to the case file; when missing, named after `geometry` and `parameters`"});
  v.key("geometry", o.geometry, {.doc = "gmsh .geo file from which `windhover mesh` makes the mesh"});
  v.key("parameters", o.parameters, {.doc = "numbers handed to the geometry, in place of its DefineConstant defaults"});
  v.key("scale_m", o.scale_m, {.doc = "metres per unit of the mesh file", .above = 0});
  v.key("refine", o.refine, {.doc = "all sizes of [airframe], [[rotor]] and farfield are divided by it", .above = 0});
  v.key("resolution", o.resolution, {.doc = "one of mesh.resolutions; when missing, refine alone counts"});
  v.key("resolutions", o.resolutions, {.doc = "names for values by which all sizes are divided, beside refine", .above = 0});
  v.key("min_dihedral_deg", o.min_dihedral_deg,
        {.doc = "`windhover mesh` refuses a mesh with a smaller angle between two faces of a cell", .min = 0});
  v.key("min_edge_m", o.min_edge_m,
        {.doc = "and with a shorter edge; missing: 1e-4 of the smallest rotor's radius, over refine", .min = 0});
  v.section("farfield", o.farfield, "The ball around airframe and rotors.");
}

template <class V>
void declare(V& v, RiemannState& o) {
  v.key("density_kg_m3", o.density_kg_m3, {.doc = "density", .above = 0});
  v.key("velocity_m_s", o.velocity_m_s, {.doc = "velocity along the direction of the jump"});
  v.key("pressure_Pa", o.pressure_Pa, {.doc = "pressure", .above = 0});
}

template <class V>
void declare(V& v, InitialOptions& o) {
  v.key("kind", o.kind,
        {.doc = "the free stream everywhere, two states with a jump between them, or the free stream with a vortex",
         .choices = {"uniform", "riemann", "vortex"}});
  v.when("kind", o.kind, "riemann", [&] {
    v.key("direction", o.direction, {.doc = "normal of the jump, from left to right; any length"});
    v.key("position_m", o.position_m, {.doc = "place of the jump along its normal"});
    v.section("left", o.left, "The state before the jump.");
    v.section("right", o.right, "The state behind the jump.");
  });
  v.when("kind", o.kind, "vortex", [&] {
    v.key("center_m", o.center_m, {.doc = "a point of the axis, which is parallel to z"});
    v.key("strength", o.strength,
          {.doc = "β: the peak velocity is β/(2π) sound speeds, counter-clockwise seen from +z"});
    v.key("core_radius_m", o.core_radius_m, {.doc = "radius of the peak velocity", .above = 0});
  });
}

template <class V>
void declare(V& v, FluidOptions& o) {
  v.key("gamma", o.gamma, {.doc = "ratio of specific heats", .above = 1});
  v.key("density_kg_m3", o.density_kg_m3, {.doc = "density of the free stream", .above = 0});
  v.key("sound_speed_m_s", o.sound_speed_m_s,
        {.doc = "sound speed of the free stream; its pressure follows from this and the density", .above = 0});
  v.key("length_m", o.length_m, {.doc = "reference length, of `time.step_nondim` among others", .above = 0});
  v.key("flux", o.flux, {.doc = "flux between cells", .choices = {"roe", "hllc", "slau2"}});
  v.key("low_mach", o.low_mach, {.doc = "less dissipation in slow flow (roe)"});
  v.key("order", o.order, {.doc = "order in space", .min = 1, .max = 2});
  v.key("gradient", o.gradient, {.doc = "gradient of a cell", .choices = {"green_gauss", "least_squares"}});
  v.key("limiter", o.limiter, {.doc = "limiter of the gradient, needed for shocks", .choices = {"none", "van_leer"}});
  v.key("limiter_epsilon", o.limiter_epsilon,
        {.doc = "jumps smaller than this fraction of the free stream are not limited", .above = 0});
  v.key("boundary", o.boundary,
        {.doc = "condition of each physical surface of the mesh; periodic surfaces need none",
         .choices = {"wall", "farfield", "symmetry"}});
  v.section("initial", o.initial, "The flow at the start.");
}

template <class V>
void declare(V& v, WindChangeOptions& o) {
  v.key("kind", o.kind,
        {.doc = "ramp: linear, and stays (without duration_s: a step); gust: half of (1 - cos), and is over",
         .choices = {"ramp", "gust"}});
  v.key("start_s", o.start_s, {.doc = "when it begins", .min = 0});
  v.key("duration_s", o.duration_s, {.doc = "how long it lasts", .min = 0});
  v.key("velocity_m_s", o.velocity_m_s, {.doc = "the change of velocity, inertial axes: all of a ramp's, the largest of a gust's"});
}

template <class V>
void declare(V& v, WindOptions& o) {
  v.key("velocity_m_s", o.velocity_m_s, {.doc = "velocity of the free stream in the inertial frame"});
  v.tables("change", o.change,
           "Changes of the wind, which add up. The air changes its velocity everywhere at once, as in a gust that is long beside "
           "the aircraft: the flow is solved in axes that move with the change (field-velocity method).");
}

template <class V>
void declare(V& v, MotionOptions& o) {
  v.key("kind", o.kind, {.doc = "kind of motion", .choices = {"translation", "rotation"}});
  v.when("kind", o.kind, "translation", [&] {
    v.key("direction", o.direction, {.doc = "direction of the translation; any length"});
    v.key("mean_m", o.mean_m, {.doc = "distance = mean + rate t + amplitude sin(2π frequency t + phase)"});
    v.key("rate_m_s", o.rate_m_s, {.doc = "steady part of the velocity"});
    v.key("amplitude_m", o.amplitude_m, {.doc = "amplitude of the oscillation"});
  });
  v.when("kind", o.kind, "rotation", [&] {
    v.key("axis", o.axis, {.doc = "axis of the rotation; any length"});
    v.key("point_m", o.point_m, {.doc = "a point of the axis"});
    v.key("mean_deg", o.mean_deg, {.doc = "angle = mean + rate t + amplitude sin(2π frequency t + phase)"});
    v.key("rate_deg_s", o.rate_deg_s, {.doc = "steady part of the angular velocity"});
    v.key("amplitude_deg", o.amplitude_deg, {.doc = "amplitude of the oscillation"});
  });
  v.key("frequency_hz", o.frequency_hz, {.doc = "frequency of the oscillation", .min = 0});
  v.key("phase_deg", o.phase_deg, {.doc = "phase of the oscillation at t = 0"});
}

template <class V>
void declare(V& v, BodyOptions& o) {
  v.key("walls", o.walls, {.doc = "the walls whose loads are summed; when missing, every wall"});
  v.key("moment_point_m", o.moment_point_m, {.doc = "the point of the body that moments are taken about"});
  v.key("kind", o.kind,
        {.doc = "how the body moves: prescribed by [[body.motion]], or dynamic: under the loads of the air, gravity and its mount; "
                "where prescribed is written out, the keys of dynamic bodies are allowed and unused, and [[rotor]] and [[zone]] turn as they say",
         .choices = {"prescribed", "dynamic"}});
  v.when("kind", o.kind, "prescribed",
         [&] { v.tables("motion", o.motion, "Prescribed motion: elementary motions, the first outermost."); });
  const auto dynamic = [&] {
    v.key("center_of_gravity_m", o.center_of_gravity_m, {.doc = "the centre of gravity in the axes of the mesh; without mass_kg it, mass and inertia are those of the parts of "
                "[airframe] and [[rotor]]"});
    declare(v, o.vehicle);
    v.section("integrator", o.integrator, "CVODE, which integrates body, motors and controller.");
  };
  v.when("kind", o.kind, "dynamic", dynamic, true);  // --set body.kind=prescribed is enough to hold a body that flies
}

template <class V>
void declare(V& v, RotorModelOptions& o) {
  v.key("name", o.name, {.doc = "the rotor of the body"});
  v.key("position_m", o.position_m, {.doc = "its hub in the axes of the mesh; when missing, the point_m of the zone of that name"});
  v.key("thrust_axis", o.thrust_axis, {.doc = "direction of its thrust in body axes, parallel to the spin axis; any length"});
  v.key("thrust_N_s2", o.thrust_N_s2, {.doc = "thrust over the square of the speed in rad/s", .above = 0});
  v.key("torque_Nm_s2", o.torque_Nm_s2, {.doc = "torque of the air over the square of the speed", .min = 0});
  v.key("min_speed_rad_s", o.min_speed_rad_s, {.doc = "lowest speed to command", .min = 0});
  v.key("max_speed_rad_s", o.max_speed_rad_s, {.doc = "highest speed to command", .above = 0});
}

template <class V>
void declare(V& v, ControllerOptions& o) {
  declare(v, o.law);
  v.tables("rotor", o.rotor, "What a controller other than \"none\" knows of each of the body's rotors.");
}

template <class V>
void declare(V& v, ZoneOptions& o) {
  v.key("name", o.name, {.doc = "the zone: a physical volume of the mesh"});
  v.key("parent", o.parent, {.doc = "the zone around it"});
  v.key("inner_surface", o.inner_surface, {.doc = "physical surface of the zone where it slides; when missing, its name + \"_slide\""});
  v.key("outer_surface", o.outer_surface, {.doc = "the parent's physical surface there; when missing, the same name"});
  v.key("shape", o.shape, {.doc = "surface of revolution between the two", .choices = {"cylinder", "sphere"}});
  v.key("point_m", o.point_m, {.doc = "a point of the axis, in the parent's frame; a sphere's centre"});
  v.key("axis", o.axis, {.doc = "axis of the rotation, in the parent's frame; any length"});
  v.key("radius_m", o.radius_m, {.doc = "radius of the surface", .min = 0});
  v.when("shape", o.shape, "cylinder", [&] {
    v.key("from_m", o.from_m, {.doc = "place of one disc along the axis, from the point"});
    v.key("to_m", o.to_m, {.doc = "place of the other disc, further along"});
  });
  v.key("mean_deg", o.mean_deg, {.doc = "angle = mean + rate t + amplitude sin(2π frequency t + phase), right-handed"});
  v.key("rate_deg_s", o.rate_deg_s, {.doc = "steady part of the angular velocity"});
  v.key("amplitude_deg", o.amplitude_deg, {.doc = "amplitude of an oscillation"});
  v.key("frequency_hz", o.frequency_hz, {.doc = "frequency of the oscillation", .min = 0});
  v.key("phase_deg", o.phase_deg, {.doc = "phase of the oscillation at t = 0"});
}

template <class V>
void declare(V& v, TimeOptions& o) {
  v.key("scheme", o.scheme,
        {.doc = "time scheme; ssp_rk3 is explicit",
         .choices = {"crank_nicolson", "backward_euler", "bdf2", "sdirk2", "ssp_rk3"}});
  v.key("step_s", o.step_s, {.doc = "time step (exactly one of the three)", .above = 0});
  v.key("step_deg", o.step_deg, {.doc = "time step as an angle of the fastest steady rotation", .above = 0});
  v.key("step_nondim", o.step_nondim, {.doc = "time step in length_m / sound_speed_m_s", .above = 0});
  v.key("steps", o.steps, {.doc = "number of time steps (exactly one of this and end_s)", .min = 0});
  v.key("end_s", o.end_s, {.doc = "time at which the run ends", .above = 0});
  v.key("first_step_ratio", o.first_step_ratio,
        {.doc = "first step over the nominal one, from which steps double: for steady flows with large steps", .above = 0, .max = 1});
  v.key("damping", o.damping,
        {.doc = "share w of BDF2 in crank_nicolson, which alone lets an oscillation from step to step go on for ever; "
                "what is stiff shrinks by (1 - w)/(1 + w) a step; second order for any w", .min = 0, .max = 1});
  v.key("start_steps", o.start_steps, {.doc = "backward-Euler steps at the start, for impulsive starts; none with start_from in the same wind", .min = 0});
  v.key("start_from", o.start_from,
        {.doc = "folder of a run or trim on the same mesh from whose newest checkpoint flow and vehicle start, at t = 0; the air gains what the wind differs"});
}

template <class V>
void declare(V& v, SolverOptions& o) {
  v.key("method", o.method,
        {.doc = "what solves an implicit step: Newton's method, or dual time, which goes there by explicit pseudo-steps "
                "(rational Runge-Kutta) and uses none of the keys of preconditioner, Jacobian and Krylov",
         .choices = {"newton_krylov", "dual_time"}});
  v.key("preconditioner", o.preconditioner,
        {.doc = "preconditioner; ilu: of each rank's cells and a layer of its neighbours', asm: the same by PETSc in double precision, blind to what crosses sliding interfaces, rrk: rational Runge-Kutta steps, rrk-multigrid: aggregation multigrid smoothed by them, over ilu",
         .choices = {"ilu", "asm", "rrk", "rrk-multigrid", "point_block_jacobi", "lu", "none"}});
  v.key("ilu_levels", o.ilu_levels, {.doc = "levels of fill of the incomplete factors", .min = 0, .max = 10});
  v.key("jacobian", o.jacobian,
        {.doc = "Jacobian products by forward differentiation (in single precision where a linear solve asks for no less than 1e-3) or by differences",
         .choices = {"exact", "difference"}});
  v.key("newton_tolerance", o.newton_tolerance,
        {.doc = "fall of the residual over a step's Newton iterations or pseudo-steps, against the rate of change of the flow", .above = 0, .max = 1});
  v.key("truncation_fraction", o.truncation_fraction,
        {.doc = "of a Crank-Nicolson step's truncation error: a residual that small is enough, even if newton_tolerance asks for less", .min = 0, .max = 1});
  v.key("newton_iterations", o.newton_iterations, {.doc = "Newton iterations before a step is halved", .min = 1});
  v.key("dual_time_iterations", o.dual_time_iterations, {.doc = "pseudo-steps of dual time before a step is halved", .min = 1});
  v.key("dual_time_cfl", o.dual_time_cfl,
        {.doc = "acoustic Courant number of each cell's pseudo-step, which the step itself bounds besides", .above = 0});
  v.key("eisenstat_walker", o.eisenstat_walker, {.doc = "choose the Krylov tolerance by Eisenstat and Walker; a solve may then end with the preconditioner alone"});
  v.key("krylov_tolerance", o.krylov_tolerance,
        {.doc = "fall of the linear residual when eisenstat_walker is false", .above = 0, .max = 1});
  v.key("krylov_iterations", o.krylov_iterations, {.doc = "Krylov iterations per Newton iteration, at most", .min = 1});
  v.key("krylov_restart", o.krylov_restart, {.doc = "Krylov vectors kept before a restart", .min = 1});
  v.key("jacobian_lag", o.jacobian_lag,
        {.doc = "steps that a preconditioner serves at most; it is made anew when its age has cost what making it costs, a step has changed "
                "by a quarter or was refused, and after each checkpoint", .min = 1});
  v.key("extrapolate", o.extrapolate, {.doc = "first guess of a step extrapolated from the last three, at the entropy of the last"});
  v.key("max_halvings", o.max_halvings, {.doc = "halvings of a failed step before the run stops", .min = 0, .max = 30});
}

template <class V>
void declare(V& v, OutputOptions& o) {
  v.key("directory", o.directory, {.doc = "folder of the results; when missing, results/<name of the case>"});
  v.key("fields_interval", o.fields_interval,
        {.doc = "steps between field outputs; 0: only the first and the last", .min = 0});
  v.key("checkpoint_interval", o.checkpoint_interval,
        {.doc = "steps between checkpoints; the end of a run is one as well", .min = 1});
  v.key("average_from_s", o.average_from_s, {.doc = "start of the averages in summary.json", .min = 0});
  v.key("span_strips", o.span_strips,
        {.doc = "strips of a rotor blade in the tables of loads along the span; 0: no such tables", .min = 0, .max = 200});
  v.key("section_r_over_R", o.section_r_over_R,
        {.doc = "radii over R of the sections of each rotor's blades in the tables of pressure around them", .above = 0, .max = 1});
}

template <class V>
void declare(V& v, Case& o) {
  v.key("like", o.like, {.doc = "a case file in the same folder whose keys hold where this one has no others; its mesh is shared"});
  v.section("mesh", o.mesh, "Where the mesh is and how it is made.");
  v.section("fluid", o.fluid, "The gas, the boundaries and the discretisation in space.");
  v.section("wind", o.wind, "The air far away.");
  v.section("body", o.body, "The body: its walls and its motion.");
  v.section("airframe", o.airframe,
            "The airframe that `windhover mesh` makes, a solid in the zone \"outer\"; its wall is the surface \"airframe\".");
  v.tables("rotor", o.rotor,
           "Rotors that `windhover mesh` makes. Each is a [[zone]] in the zone \"outer\", its walls are the surfaces name + "
           "\"_blades\" and name + \"_hub\", the ball is the surface \"farfield\".");
  v.tables("zone", o.zone, "Zones that turn inside others; the rest of the mesh moves with the body.");
  v.section("controller", o.controller, "What commands the rotors of a dynamic body.");
  v.section("coupling", o.coupling, "How a dynamic body and the air are brought together in a step.");
  v.section("trim", o.trim, "What `windhover trim` seeks, and when it has found it.");
  v.section("time", o.time, "The discretisation in time.");
  v.section("solver", o.solver, "Newton's method and the linear solver of a time step.");
  v.section("output", o.output, "What is written, and where.");
}

}  // namespace windhover::app
