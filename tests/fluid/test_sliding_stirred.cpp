// A closed box stirred by a paddle in a spinning zone: no mass is lost, and the gas keeps all the work that is done on it.
#include <catch2/catch.hpp>

#include "sliding_flow.h"

using namespace windhover;
using namespace windhover::fluid;

TEST_CASE("a stirred closed box keeps its mass and the paddle's work over ten turns", "[sliding][stirred]") {
  const mesh::SlidingCase sliding = paddle_case({{"h", 0.3}, {"paddle", 1}});
  const mesh::Mesh& mesh = sliding.mesh;
  EulerOperator euler(mesh, walled(mesh), sliding.interfaces);
  FlowOptions options;
  options.newton.tolerance = 1e-12;
  options.newton.max_iterations = 40;
  options.newton.eisenstat_walker = false;
  options.newton.krylov_tolerance = 1e-4;
  FlowSolver solver(euler, options);
  constexpr double rate = 0.8;  // the paddle's tips at Mach 0.28
  constexpr int steps_per_turn = 24, turns = 10;
  const double dt = 2 * M_PI / rate / steps_per_turn;
  const FrameFunction frames = spinning(mesh, paddle_surface(), sliding.interface().zone(0), rate, {});
  set_initial(euler, frames(0), uniform_state({1, 0, 0, 0, 1 / 1.4}), solver.state().q);

  const auto torque = [&] {  // of the paddle on the gas, about the axis
    const auto fluxes = euler.patch_fluxes(solver.state().q, frames(solver.state().time));
    for (size_t p = 0; p < fluxes.size(); ++p)
      if (mesh.patches[p].name == "paddle") return -fluxes[p].moment.z();
    return std::nan("");
  };
  const double mass = total(mesh, solver.state().q, 0), energy = total(mesh, solver.state().q, 4);
  double work = 0, mass_error = 0, energy_error = 0;
  for (int step = 0; step < turns * steps_per_turn; ++step) {
    work += 0.5 * dt * rate * torque();
    const StepReport report = solver.advance(frames, dt);
    INFO(report.reason);
    REQUIRE(report.accepted);
    work += 0.5 * dt * rate * torque();
    mass_error = std::max(mass_error, std::abs(total(mesh, solver.state().q, 0) / mass - 1));
    energy_error = std::max(energy_error, std::abs(total(mesh, solver.state().q, 4) - energy - work));
  }
  CHECK(mass_error < 1e-12);
  CHECK(energy_error < 1e-10 * work);
}
