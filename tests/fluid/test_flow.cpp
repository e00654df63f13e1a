// Whole steps: uniform flow stays uniform, closed boxes conserve, ranks and schemes agree.
#include <catch2/catch.hpp>

#include "flow_fixture.h"

using namespace windhover;
using namespace windhover::fluid;

namespace {

FlowOptions tight(const std::string& scheme, double damping = 0) {
  FlowOptions options;
  options.damping = damping;
  options.scheme = &time_scheme(scheme);
  options.newton.tolerance = 1e-13;
  options.newton.max_iterations = 30;
  options.newton.eisenstat_walker = false;
  options.newton.krylov_tolerance = 1e-4;
  return options;
}

/// Σ over cells of V q, all ranks; long double within a rank.
std::array<double, 5> totals(const EulerOperator& euler, Vec q) {
  const double* v = nullptr;
  petsc(VecGetArrayRead(q, &v));
  std::array<double, 5> sum{};
  for (int k = 0; k < 5; ++k) {
    long double s = 0;
    for (mesh::Index c = 0; c < euler.mesh().n_owned; ++c) s += (long double)(euler.mesh().volume[c]) * v[5 * c + k];
    sum[k] = static_cast<double>(s);
  }
  petsc(VecRestoreArrayRead(q, &v));
  MPI_Allreduce(MPI_IN_PLACE, sum.data(), 5, MPI_DOUBLE, MPI_SUM, euler.mesh().comm);
  return sum;
}

/// ‖V (q_n − q_{n−1}) / Δt‖, all ranks.
double rate_of_change(const EulerOperator& euler, const FlowState& state) {
  VecHandle change = euler.make_vector();
  petsc(VecWAXPY(change, -1, state.previous, state.q));
  double* v = nullptr;
  petsc(VecGetArray(change, &v));
  for (mesh::Index c = 0; c < euler.mesh().n_owned; ++c)
    for (int k = 0; k < 5; ++k) v[5 * c + k] *= euler.mesh().volume[c] / state.last_step;
  petsc(VecRestoreArray(change, &v));
  return norm(change);
}

}  // namespace

TEST_CASE("uniform flow through a tumbling, translating mixed mesh stays uniform", "[flow][uniform]") {
  const std::string scheme = GENERATE("crank_nicolson", "backward_euler", "bdf2", "sdirk2", "ssp_rk3");
  const double damping = scheme == "crank_nicolson" ? GENERATE(0.0, 0.25) : 0;
  CAPTURE(scheme, damping);
  const mesh::Mesh mesh = mesh::read_mesh(make_mesh("mixed", {{"distortion", 0.2}}), 1.0, PETSC_COMM_WORLD);
  FlowModel model = model_for(mesh);
  model.far = {1.0, 0.3, -0.2, 0.1, 1 / 1.4};
  EulerOperator euler(mesh, model);
  FlowSolver solver(euler, tight(scheme, damping));
  const FrameFunction frames = frames_of(mesh, tumbling());
  set_initial(euler, frames(0), uniform_state(model.far), solver.state().q);
  VecHandle start = euler.make_vector();
  petsc(VecCopy(solver.state().q, start));
  // acoustic Courant number 50; the explicit scheme at its limit
  const double courant = time_scheme(scheme).implicit ? 50 : 0.8;
  const double dt = courant / euler.courant_number(start, frames(0), 1.0);
  for (int step = 0; step < 100; ++step) REQUIRE(solver.advance(frames, dt).accepted);
  CHECK(distance(solver.state().q, start, NORM_INFINITY) < 1e-12);
}

TEST_CASE("a closed box conserves mass, momentum with the walls' force, and energy with their work", "[flow][closed]") {
  const std::string scheme = GENERATE("crank_nicolson", "backward_euler", "ssp_rk3");
  CAPTURE(scheme);
  const mesh::Mesh mesh = mesh::read_mesh(make_mesh("mixed", {{"distortion", 0.2}}), 1.0, PETSC_COMM_WORLD);
  EulerOperator euler(mesh, closed_box(mesh));
  const FlowOptions options = tight(scheme);
  FlowSolver solver(euler, options);
  const FrameFunction frames = frames_of(mesh, tumbling(0.15));
  // a jump inside a box that moves: strong waves, walls that do work
  const State<double> left{1.0, 0, 0, 0, 1 / 1.4}, right{0.7, 0.1, 0, 0, 0.8 / 1.4};
  set_initial(euler, frames(0), riemann_state(mesh::Vec3(1, 0.5, 0.2), 0.9, left, right), solver.state().q);
  const double courant = options.scheme->implicit ? 10 : 0.8;
  const double dt = courant / euler.courant_number(solver.state().q, frames(0), 1.0);
  const auto before = totals(euler, solver.state().q);
  std::array<double, 5> through{};  // what passed the walls
  const auto add = [&](double weight, Vec q, double t) {
    for (const auto& p : euler.patch_fluxes(q, frames(t))) {
      const double f[5] = {p.flux.mass, p.flux.x, p.flux.y, p.flux.z, p.flux.energy};
      for (int k = 0; k < 5; ++k) through[k] += weight * f[k];
    }
  };
  for (int step = 0; step < 20; ++step) {
    const double t = solver.state().time;
    const bool half = scheme == "crank_nicolson";
    if (half) add(0.5 * dt, solver.state().q, t);
    const StepReport report = solver.advance(frames, dt);
    INFO(report.reason);
    REQUIRE(report.accepted);
    if (options.scheme->implicit) add(half ? 0.5 * dt : dt, solver.state().q, t + dt);
  }
  const auto after = totals(euler, solver.state().q);
  CHECK(std::abs(after[0] - before[0]) < 1e-12 * before[0]);
  if (!options.scheme->implicit) return;  // its stages' wall fluxes are not at hand
  for (int k = 1; k < 5; ++k) {
    CAPTURE(k, before[k], after[k], through[k]);
    CHECK(std::abs(after[k] - before[k] + through[k]) < 1e-12 * before[4]);
  }
}

TEST_CASE("damped Crank-Nicolson is of second order with steps that change, and conserves mass", "[flow]") {
  const double damping = GENERATE(0.25, 1.0);
  CAPTURE(damping);
  const mesh::Mesh mesh = mesh::read_mesh(make_mesh("cube"), 1.0, PETSC_COMM_WORLD);
  EulerOperator euler(mesh, closed_box(mesh));
  const FrameFunction frames = frames_of(mesh, {});
  const auto end_of = [&](int pairs) {
    FlowSolver solver(euler, tight("crank_nicolson", damping));
    set_initial(euler, frames(0), vortex_state({0.5, 0.5, 0}, 1, 0.15, {1.0, 0, 0, 0, 1 / 1.4}, 1.4), solver.state().q);
    const double mass = totals(euler, solver.state().q)[0];
    for (int i = 0; i < pairs; ++i)
      for (const double part : {0.4, 0.6}) REQUIRE(solver.advance(frames, part * 0.8 / pairs).accepted);
    CHECK(std::abs(totals(euler, solver.state().q)[0] - mass) < 1e-12 * mass);
    return std::move(solver.state().q);
  };
  const VecHandle fine = end_of(256);
  const double error[3] = {distance(end_of(16), fine), distance(end_of(32), fine), distance(end_of(64), fine)};
  CAPTURE(error[0], error[1], error[2]);
  CHECK(std::log2(error[0] / error[1]) > 1.9);
  CHECK(std::log2(error[1] / error[2]) > 1.9);
}

TEST_CASE("Newton's method that stops at a fraction of the truncation error leaves its order and size, for fewer iterations", "[flow]") {
  const double damping = GENERATE(0.0, 0.25);
  CAPTURE(damping);
  const mesh::Mesh mesh = mesh::read_mesh(make_mesh("cube"), 1.0, PETSC_COMM_WORLD);
  EulerOperator euler(mesh, closed_box(mesh));
  const FrameFunction frames = frames_of(mesh, {});
  const auto end_of = [&](int steps, double tolerance, double fraction, int& newton) {
    FlowOptions options = tight("crank_nicolson", damping);
    options.newton.tolerance = tolerance;
    options.truncation_fraction = fraction;
    FlowSolver solver(euler, options);
    set_initial(euler, frames(0), vortex_state({0.5, 0.5, 0}, 1, 0.15, {1.0, 0, 0, 0, 1 / 1.4}, 1.4), solver.state().q);
    for (int i = 0; i < steps; ++i) {
      const StepReport report = solver.advance(frames, 0.8 / steps);
      REQUIRE(report.accepted);
      newton += report.newton();
    }
    return std::move(solver.state().q);
  };
  int newton = 0;
  const VecHandle fine = end_of(512, 1e-13, 0, newton);
  double error[3] = {};
  for (int i = 0; i < 3; ++i) {
    const int steps = 32 << i;
    int all = 0, enough = 0;
    const double solved = distance(end_of(steps, 1e-9, 0, all), fine);
    error[i] = distance(end_of(steps, 1e-9, 0.3, enough), fine);
    CAPTURE(steps, all, enough, solved, error[i]);
    CHECK(error[i] < 1.3 * solved);
    CHECK(enough < 0.7 * all);
  }
  CAPTURE(error[0], error[1], error[2]);
  CHECK(std::log2(error[0] / error[1]) > 1.9);
  CHECK(std::log2(error[1] / error[2]) > 1.9);
}

TEST_CASE("what Newton's method leaves where Crank-Nicolson is stiff does not ring", "[flow]") {
  const mesh::Mesh mesh = mesh::read_mesh(make_mesh("cube"), 1.0, PETSC_COMM_WORLD);
  EulerOperator euler(mesh, closed_box(mesh));
  const FrameFunction frames = frames_of(mesh, {});
  FlowOptions options = tight("crank_nicolson");
  options.extrapolate = false;
  FlowSolver exact(euler, options);
  options.newton.tolerance = 1;  // takes any guess for solved
  FlowSolver careless(euler, options);
  FlowState &from = careless.state(), &to = exact.state();
  const State<double> still{1, 0, 0, 0, 1 / 1.4};
  set_initial(euler, frames(0), uniform_state(still), from.q);
  VecHandle at_rest = euler.make_vector();
  petsc(VecCopy(from.q, at_rest));
  const double dt = 100 / euler.courant_number(at_rest, frames(0), 1.0);

  careless.begin(frames, dt);
  double* guess = nullptr;  // sound from cell to cell
  petsc(VecGetArray(careless.iterate(), &guess));
  for (mesh::Index c = 0; c < mesh.n_owned; ++c) {
    const double dp = 1e-4 * noise(mesh.file_cell[c], 0);
    conserved(State<double>{1 + dp, 0, 0, 0, still.p + dp}, 1.4, guess + kVariables * c);
  }
  petsc(VecRestoreArray(careless.iterate(), &guess));
  REQUIRE(careless.iterate(frames).newton() == 0);
  careless.accept();
  const double left = distance(from.q, at_rest);
  petsc(VecCopy(from.q, to.q));
  petsc(VecCopy(from.previous, to.previous));
  petsc(VecCopy(from.remainder, to.remainder));
  to.last_step = from.last_step;
  REQUIRE(exact.advance(frames, dt).accepted);
  CAPTURE(left, distance(to.q, at_rest));
  CHECK(left > 1e-3);
  CHECK(distance(to.q, at_rest) < 0.2 * left);  // with R(q) itself: 0.98 of it
}

TEST_CASE("a truncation error that is but noise excuses no residual above a fiftieth of the rate of change, and is forgotten", "[flow]") {
  const mesh::Mesh mesh = mesh::read_mesh(make_mesh("cube"), 1.0, PETSC_COMM_WORLD);
  EulerOperator euler(mesh, closed_box(mesh));
  const FrameFunction frames = frames_of(mesh, {});
  FlowOptions options = tight("crank_nicolson", 0.25);
  options.newton.tolerance = 1e-9;
  options.newton.eisenstat_walker = true;  // linear solves that go for Newton's target
  options.newton.preconditioner = &preconditioner("point_block_jacobi");  // and do not pass it by far
  options.truncation_fraction = 0.3;
  FlowSolver solver(euler, options);
  set_initial(euler, frames(0), vortex_state({0.5, 0.5, 0}, 1, 0.15, {1.0, 0, 0, 0, 1 / 1.4}, 1.4), solver.state().q);
  constexpr double dt = 0.02;
  const auto step = [&] {
    const double rate = rate_of_change(euler, solver.state());
    const StepReport report = solver.advance(frames, dt);
    INFO(report.reason);
    REQUIRE(report.accepted);
    return report.stages.back().iterations.back().residual / rate;
  };
  for (int i = 0; i < 8; ++i) step();
  const double third = solver.state().third, sound = step();
  solver.state().third = 1e6 * third;
  const double left = step();
  CAPTURE(third, sound, left);
  CHECK(left > 2 * sound);  // some is excused
  CHECK(left < 0.02);
  for (int i = 0; i < 4; ++i) step();
  CHECK(solver.state().third < 1.2 * third);
}

TEST_CASE("preconditioners, kinds of products and ranks lead to the same flow, and conserve mass", "[flow]") {
  const bool closed = GENERATE(false, true);
  CAPTURE(closed);
  const mesh::Mesh mesh = mesh::read_mesh(make_mesh("cube"), 1.0, PETSC_COMM_WORLD);
  FlowModel model = closed ? closed_box(mesh) : model_for(mesh, {{"wall", BoundaryKind::wall}});
  model.far = {1.0, 0, 0.3, 0, 1 / 1.4};
  const auto run = [&](const Preconditioner& p, bool exact, bool eisenstat_walker, int lag = 1) {
    CAPTURE(p.name, exact, eisenstat_walker, lag);
    EulerOperator euler(mesh, model);
    FlowOptions options = tight("crank_nicolson");
    options.newton.preconditioner = &p;
    options.newton.exact_jacobian = exact;
    options.newton.eisenstat_walker = eisenstat_walker;
    options.newton.tolerance = 1e-11;
    options.jacobian_lag = lag;
    FlowSolver solver(euler, options);
    const FrameFunction frames = frames_of(mesh, {});
    set_initial(euler, frames(0), vortex_state({0.5, 0.5, 0}, 1, 0.15, model.far, 1.4), solver.state().q);
    const double mass = totals(euler, solver.state().q)[0];
    for (int step = 0; step < 5; ++step) {
      const StepReport report = solver.advance(frames, 0.1);
      INFO(report.reason);
      REQUIRE(report.accepted);
    }
    if (closed) CHECK(std::abs(totals(euler, solver.state().q)[0] - mass) < 1e-11 * mass);
    return std::move(solver.state().q);
  };
  const VecHandle reference = run(preconditioner("lu"), true, false);
  for (const Preconditioner& p : kPreconditioners) {
    CAPTURE(p.name);
    CHECK(distance(run(p, true, false), reference, NORM_INFINITY) < 1e-9);
  }
  CHECK(distance(run(preconditioner("ilu"), false, false), reference, NORM_INFINITY) < 1e-9);
  CHECK(distance(run(preconditioner("ilu"), true, true), reference, NORM_INFINITY) < 1e-9);
  CHECK(distance(run(preconditioner("ilu"), true, true, 3), reference, NORM_INFINITY) < 1e-9);
  CHECK(distance(run(preconditioner("rrk-multigrid"), true, true, 3), reference, NORM_INFINITY) < 1e-9);
}

TEST_CASE("a preconditioner turns with its zone: it is as good half a turn later", "[flow]") {
  const bool exact = GENERATE(true, false);
  CAPTURE(exact);
  const mesh::Mesh mesh = mesh::read_mesh(make_mesh("cube"), 1.0, PETSC_COMM_WORLD);
  const FlowModel model = model_for(mesh);
  EulerOperator euler(mesh, model);
  const FrameFunction frames = frames_of(mesh, {mesh::Rotation{mesh::Vec3(1, 2, 2) / 3, {0.5, 0.5, 0.5}, {.rate = 1}}});
  const auto run = [&](int lag, int& krylov) {
    FlowOptions options = tight("crank_nicolson");
    options.newton.exact_jacobian = exact;
    options.newton.tolerance = 1e-10;
    options.jacobian_lag = lag;
    FlowSolver solver(euler, options);
    set_initial(euler, frames(0), vortex_state({0.5, 0.5, 0}, 0.1, 0.15, model.far, 1.4), solver.state().q);
    krylov = 0;
    for (int step = 0; step < 10; ++step) {
      const StepReport report = solver.advance(frames, 0.3);
      INFO(report.reason);
      REQUIRE(report.accepted);
      krylov += report.krylov();
    }
    return std::move(solver.state().q);
  };
  int fresh = 0, turned = 0;
  const VecHandle reference = run(1, fresh);
  CHECK(distance(run(100, turned), reference, NORM_INFINITY) < 1e-9);
  CAPTURE(fresh, turned);
  CHECK(turned < 1.05 * fresh);
}

namespace {

struct CrankNicolsonCube {
  mesh::Mesh mesh = mesh::read_mesh(make_mesh("cube"), 1.0, PETSC_COMM_WORLD);
  EulerOperator euler{mesh, model_for(mesh)};
  FlowSolver solver{euler, {.scheme = &time_scheme("crank_nicolson")}};
};

}  // namespace

TEST_CASE("the first guess of a step follows a line in time at constant entropy, but no cell towards vacuum", "[flow]") {
  CrankNicolsonCube cube;
  const mesh::Mesh& mesh = cube.mesh;
  FlowSolver& solver = cube.solver;
  const FrameFunction frames = frames_of(mesh, {});
  // this rank's first cells; elsewhere 1 and a velocity of 0.1
  struct Cell {
    double rho_before, rho, p_before, p, u_before, p_guess, u_guess;
  };
  const std::vector<Cell> cells = {{1.1, 1.0, 1.02, 1.0, 0.08, 0.98, 0.12},  // on the line
                                   {1.6, 0.5, 1.0, 1.0, 0.08, 1.0, 0.12},    // density on it below nothing
                                   {0.5, 1.0, 1.0, 1.0, 0.1, 1.0, 0.1},      // swings
                                   {1.0, 1.0, 3.0, 1.0, 0.08, 0.8, 0.102},   // pressure on it below nothing
                                   {1.0, 1.0, 0.5, 1.0, 0.1, 1.2, 0.1}};
  const auto fill = [&](Vec q, bool now) {
    double* v = nullptr;
    petsc(VecGetArray(q, &v));
    for (mesh::Index c = 0; c < mesh.n_owned; ++c) {
      State<double> s{1, 0.1, 0, 0, 1};
      if (c < mesh::Index(cells.size())) {
        s.rho = now ? cells[c].rho : cells[c].rho_before;
        s.p = now ? cells[c].p : cells[c].p_before;
        if (!now) s.u = cells[c].u_before;
      }
      conserved(s, 1.4, v + 5 * c);
    }
    petsc(VecRestoreArray(q, &v));
  };
  FlowState& state = solver.state();
  fill(state.previous, false);
  fill(state.q, true);
  state.last_step = 0.1;
  solver.begin(frames, 0.1);
  const double* guess = nullptr;
  petsc(VecGetArrayRead(solver.iterate(), &guess));
  for (mesh::Index c = 0; c < mesh::Index(cells.size()); ++c) {
    const State<double> s = primitive(guess + 5 * c, 1.4);
    CAPTURE(c, s.rho, s.u, s.p);
    CHECK(s.rho == Approx(cells[c].rho * (1 + (cells[c].p_guess / cells[c].p - 1) / 1.4)).epsilon(1e-12));
    CHECK(s.p == Approx(cells[c].p_guess).epsilon(1e-12));
    CHECK(s.u == Approx(cells[c].u_guess).epsilon(1e-12));
  }
  petsc(VecRestoreArrayRead(solver.iterate(), &guess));
}

TEST_CASE("the first guess bends with what is smooth in time, and not with what swings", "[flow]") {
  CrankNicolsonCube cube;
  const mesh::Mesh& mesh = cube.mesh;
  FlowSolver& solver = cube.solver;
  // pressure at times −0.3, −0.1, 0 and its guess for 0.2, which is also 10 v + 1 for the velocity v
  const auto smooth = [](double t) { return 1 + 0.1 * t + 0.02 * t * t; };
  const auto swings = [](double t) { return t == -0.1 ? 1.02 : 1; };
  const auto fill = [&](Vec q, double t) {
    double* v = nullptr;
    petsc(VecGetArray(q, &v));
    for (mesh::Index c = 0; c < mesh.n_owned; ++c) {
      const double p = c % 2 ? smooth(t) : swings(t);
      conserved(State<double>{1, 0, (p - 1) / 10, 0, p}, 1.4, v + 5 * c);
    }
    petsc(VecRestoreArray(q, &v));
  };
  FlowState& state = solver.state();
  fill(state.earlier, -0.3);
  fill(state.previous, -0.1);
  fill(state.q, 0);
  state.step_before = 0.2;
  state.last_step = 0.1;
  solver.begin(frames_of(mesh, {}), 0.2);
  const double* guess = nullptr;
  petsc(VecGetArrayRead(solver.iterate(), &guess));
  double off[2] = {};  // from the parabola through the smooth values, from the line through those that swing
  const double line = smooth(0) + 2 * (smooth(0) - smooth(-0.1)), swung = 1 - 2 * 0.02;
  for (mesh::Index c = 0; c < mesh.n_owned; ++c) {
    const State<double> s = primitive(guess + 5 * c, 1.4);
    const double expected = c % 2 ? smooth(0.2) : swung;
    for (const double p : {s.p, 10 * s.v + 1}) off[c % 2 == 0] = std::max(off[c % 2 == 0], std::abs(p - expected));
  }
  petsc(VecRestoreArrayRead(solver.iterate(), &guess));
  MPI_Allreduce(MPI_IN_PLACE, off, 2, MPI_DOUBLE, MPI_MAX, mesh.comm);
  CAPTURE(off[0], off[1]);
  CHECK(off[0] == Approx(0.4 * (smooth(0.2) - line)).epsilon(0.01));  // six tenths of the way from the line
  CHECK(off[1] < 0.003);                                              // a parabola: 0.06 lower
}

TEST_CASE("a step that cannot be solved is refused and leaves the state as it was", "[flow]") {
  const mesh::Mesh mesh = mesh::read_mesh(make_mesh("cube"), 1.0, PETSC_COMM_WORLD);
  EulerOperator euler(mesh, closed_box(mesh));
  FlowOptions options;
  options.newton.max_iterations = 1;
  options.newton.tolerance = 1e-12;
  FlowSolver solver(euler, options);
  const FrameFunction frames = frames_of(mesh, {});
  set_initial(euler, frames(0), riemann_state({1, 0, 0}, 0.5, {1, 0, 0, 0, 1}, {0.1, 0, 0, 0, 0.1}), solver.state().q);
  VecHandle start = euler.make_vector();
  petsc(VecCopy(solver.state().q, start));
  const StepReport report = solver.advance(frames, 0.5);
  CHECK_FALSE(report.accepted);
  CHECK_FALSE(report.reason.empty());
  CHECK(distance(solver.state().q, start) == 0);
  CHECK(solver.state().time == 0);
  CHECK(solver.state().step == 0);
}
