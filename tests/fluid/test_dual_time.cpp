// Dual time as the solver of a step: the same answers as Newton's method, and no others.
#include <catch2/catch.hpp>

#include "sliding_flow.h"

using namespace windhover;
using namespace windhover::fluid;

namespace {

FlowOptions tight(const char* method, double tolerance = 1e-12) {
  FlowOptions options;
  options.newton = {.tolerance = tolerance, .max_iterations = 40, .eisenstat_walker = false, .krylov_tolerance = 1e-4};
  options.dual_time.tolerance = tolerance;
  for (const StageMethod& m : kStageMethods)
    if (std::string(m.name) == method) options.method = &m;
  return options;
}

/// A zone that spins in a closed vessel, and a jump through it: waves cross the interface in all directions.
struct Vessel {
  mesh::SlidingCase sliding = mesh::cylinder_case({});
  EulerOperator euler{sliding.mesh, walled(sliding.mesh), sliding.interfaces};
  FrameFunction frames = spinning(sliding.mesh, mesh::rotor_surface(), sliding.interface().zone(0), 0.9, {});

  void start(FlowSolver& solver) {
    set_initial(euler, frames(0),
                riemann_state({1, 0.3, 0.2}, 0.1, {1, 0.1, 0, 0, 1 / 1.4}, {0.8, -0.1, 0, 0, 0.8 / 1.4}),
                solver.state().q);
  }
};

}  // namespace

TEST_CASE("dual time: the steps of Newton's method through a spinning zone, and the mass kept", "[dual_time]") {
  const std::string scheme = GENERATE("crank_nicolson", "sdirk2", "bdf2");
  CAPTURE(scheme);
  Vessel vessel;
  const auto run = [&](const char* method) {
    FlowOptions options = tight(method);
    options.scheme = &time_scheme(scheme);
    options.damping = 0.25;
    FlowSolver solver(vessel.euler, options);
    vessel.start(solver);
    const double mass = vessel.euler.total(solver.state().q)[0];
    for (int step = 0; step < 5; ++step) {
      const StepReport report = solver.advance(vessel.frames, 0.05);
      INFO(method << ": " << report.reason);
      REQUIRE(report.accepted);
      for (const StageReport& stage : report.stages)  // what was left is at most what was asked for
        CHECK(stage.iterations.back().residual < stage.iterations.front().residual);
    }
    CHECK(std::abs(vessel.euler.total(solver.state().q)[0] / mass - 1) < 1e-12);
    return std::move(solver.state().q);
  };
  CHECK(distance(run("dual_time"), run("newton_krylov"), NORM_INFINITY) < 1e-9);
}

TEST_CASE("dual time: uniform flow through a tumbling mesh stays uniform", "[dual_time][uniform]") {
  const mesh::Mesh mesh = mesh::read_mesh(make_mesh("mixed", {{"distortion", 0.2}}), 1.0, PETSC_COMM_WORLD);
  FlowModel model = model_for(mesh);
  model.far = {1.0, 0.3, -0.2, 0.1, 1 / 1.4};
  EulerOperator euler(mesh, model);
  FlowSolver solver(euler, tight("dual_time", 1e-13));
  const FrameFunction frames = frames_of(mesh, tumbling());
  set_initial(euler, frames(0), uniform_state(model.far), solver.state().q);
  const VecHandle start = euler.make_vector();
  petsc(VecCopy(solver.state().q, start));
  const double dt = 50 / euler.courant_number(start, frames(0), 1.0);
  for (int step = 0; step < 20; ++step) REQUIRE(solver.advance(frames, dt).accepted);
  CHECK(distance(solver.state().q, start, NORM_INFINITY) < 1e-12);
}

TEST_CASE("dual time: Crank-Nicolson stays of second order", "[dual_time]") {
  const mesh::Mesh mesh = mesh::read_mesh(make_mesh("cube"), 1.0, PETSC_COMM_WORLD);
  EulerOperator euler(mesh, closed_box(mesh));
  const FrameFunction frames = frames_of(mesh, {});
  const auto end_of = [&](int steps) {
    FlowSolver solver(euler, tight("dual_time", 1e-8));
    set_initial(euler, frames(0), vortex_state({0.5, 0.5, 0}, 1, 0.15, {1.0, 0, 0, 0, 1 / 1.4}, 1.4), solver.state().q);
    for (int i = 0; i < steps; ++i) REQUIRE(solver.advance(frames, 0.8 / steps).accepted);
    return std::move(solver.state().q);
  };
  const VecHandle fine = end_of(512);
  const double error[3] = {distance(end_of(32), fine), distance(end_of(64), fine), distance(end_of(128), fine)};
  CAPTURE(error[0], error[1], error[2]);
  CHECK(std::log2(error[0] / error[1]) > 1.9);
  CHECK(std::log2(error[1] / error[2]) > 1.9);
}

TEST_CASE("a step in parts is solved in each part, unless the frames have not moved", "[dual_time][flow]") {
  const std::string method = GENERATE("dual_time", "newton_krylov");
  CAPTURE(method);
  Vessel vessel;
  FlowSolver solver(vessel.euler, tight(method.c_str(), 1e-4));
  vessel.start(solver);
  solver.begin(vessel.frames, 0.05);
  const auto iterations = [&](const FrameFunction& frames) {
    for (int i = 0;; ++i) {
      const StepReport& report = solver.iterate(frames, 1, 1);
      REQUIRE(i < 20);
      if (report.accepted) return report.stages.back().iterations.size() - 1;
    }
  };
  CHECK(iterations(vessel.frames) >= 1);
  const auto slower = [&](double speed) {
    return spinning(vessel.sliding.mesh, mesh::rotor_surface(), vessel.sliding.interface().zone(0), speed, {});
  };
  CHECK(iterations(slower(0.8)) >= 1);
  CHECK(iterations(slower(0.8)) == 0);
}

TEST_CASE("dual time: too few pseudo-steps are a reason to refuse the step", "[dual_time]") {
  Vessel vessel;
  FlowOptions options = tight("dual_time");
  options.dual_time.max_iterations = 3;
  FlowSolver solver(vessel.euler, options);
  vessel.start(solver);
  const VecHandle start = vessel.euler.make_vector();
  petsc(VecCopy(solver.state().q, start));
  const StepReport report = solver.advance(vessel.frames, 0.05);
  CHECK_FALSE(report.accepted);
  CHECK_FALSE(report.failed);
  CHECK_THAT(report.reason, Catch::Contains("after 3 iterations"));
  CHECK(distance(solver.state().q, start) == 0);
  CHECK(solver.state().step == 0);
}

TEST_CASE("dual time: pseudo-steps that are no gas are a reason to refuse the step", "[dual_time]") {
  Vessel vessel;
  FlowOptions options = tight("dual_time");
  options.dual_time.cfl = 1e6;
  FlowSolver solver(vessel.euler, options);
  set_initial(vessel.euler, vessel.frames(0), riemann_state({1, 0, 0}, 0, {1, 0, 0, 0, 1}, {0.01, 0, 0, 0, 0.001}),
              solver.state().q);
  const StepReport report = solver.advance(vessel.frames, 10);
  CHECK_FALSE(report.accepted);
  CHECK_FALSE(report.reason.empty());
}
