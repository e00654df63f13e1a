#include "app/flow_setup.h"

#include <algorithm>

#include "app/wind.h"
#include "base/errors.h"

namespace windhover::app {
namespace {

/// The entry of a flat table with this name; the case has been validated, so there is one.
template <class Table>
const auto& by_name(const Table& table, const std::string& name) {
  return *std::find_if(std::begin(table), std::end(table), [&](const auto& entry) { return name == entry.name; });
}

fluid::State<double> state(const Scales& s, double density, const Vec3& velocity, double pressure) {
  return {density / s.density, velocity.x() / s.velocity, velocity.y() / s.velocity, velocity.z() / s.velocity,
          pressure / s.pressure()};
}

}  // namespace

fluid::FlowModel flow_model(const Case& c) {
  const FluidOptions& f = c.fluid;
  fluid::FlowModel model;
  model.gamma = f.gamma;
  for (const auto* flux : fluid::kFluxes)
    if (f.flux == flux->name) model.flux = flux;
  model.low_mach = f.low_mach;
  model.reconstruction = f.order == 1             ? fluid::Reconstruction::first_order
                         : f.limiter == "none"    ? fluid::Reconstruction::linear
                                                  : fluid::Reconstruction::limited;
  model.gradient = f.gradient == "green_gauss" ? fluid::GradientKind::green_gauss : fluid::GradientKind::least_squares;
  model.limiter_epsilon = f.limiter_epsilon;
  model.far = state(Scales(f), f.density_kg_m3, c.wind.velocity_m_s, f.pressure_Pa());
  for (const auto& [patch, condition] : f.boundary)
    model.boundary[patch] = by_name(fluid::kBoundaryNames, condition).kind;
  return model;
}

fluid::FlowOptions flow_options(const Case& c) {
  const SolverOptions& s = c.solver;
  fluid::FlowOptions o;
  o.scheme = &fluid::time_scheme(c.time.scheme);
  const bool goes_on = !c.time.start_from.empty() && wind_jump(c).isZero();
  o.start_steps = goes_on ? 0 : c.time.start_steps;
  o.damping = c.time.damping;
  o.truncation_fraction = s.truncation_fraction;
  o.extrapolate = s.extrapolate;
  o.jacobian_lag = s.jacobian_lag;
  o.method = &by_name(fluid::kStageMethods, s.method);
  o.newton = {.preconditioner = &fluid::preconditioner(s.preconditioner),
              .ilu_levels = s.ilu_levels,
              .exact_jacobian = s.jacobian == "exact",
              .tolerance = s.newton_tolerance,
              .max_iterations = s.newton_iterations,
              .eisenstat_walker = s.eisenstat_walker,
              .krylov_tolerance = s.krylov_tolerance,
              .krylov_iterations = s.krylov_iterations,
              .krylov_restart = s.krylov_restart};
  o.dual_time = {.tolerance = s.newton_tolerance, .max_iterations = s.dual_time_iterations, .cfl = s.dual_time_cfl};
  return o;
}

fluid::InitialState initial_state(const Case& c) {
  const Scales scales(c.fluid);
  const InitialOptions& i = c.fluid.initial;
  const fluid::State<double> far = flow_model(c).far;
  if (i.kind == "riemann") {
    const Vec3 direction = i.direction.normalized();
    const auto side = [&](const RiemannState& s) {
      return state(scales, s.density_kg_m3, s.velocity_m_s * direction, s.pressure_Pa);
    };
    return fluid::riemann_state(direction, i.position_m / scales.length, side(i.left), side(i.right));
  }
  if (i.kind == "vortex")
    return fluid::vortex_state(i.center_m / scales.length, i.strength, i.core_radius_m / scales.length, far,
                               c.fluid.gamma);
  return fluid::uniform_state(far);
}

namespace {

Signal scaled(Signal signal, double value, double time) {
  return {signal.mean / value, signal.rate * time / value, signal.amplitude / value, signal.omega * time, signal.phase};
}

}  // namespace

mesh::Rotation scaled(mesh::Rotation r, const Scales& s) {
  return {r.axis, r.point / s.length, scaled(r.angle, 1.0, s.time())};
}

mesh::Motion scaled_motion(const Case& c) {
  const Scales s(c.fluid);
  mesh::Motion motion = body_motion(c);
  for (auto& element : motion) {
    if (auto* t = std::get_if<mesh::Translation>(&element)) t->distance = scaled(t->distance, s.length, s.time());
    if (auto* r = std::get_if<mesh::Rotation>(&element)) *r = scaled(*r, s);
  }
  return motion;
}

}  // namespace windhover::app
