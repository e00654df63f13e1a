// The window and the life of a step: begin, iterate, then accept, or nothing at all.
#include "base/errors.h"
#include "coupling/quadcopter_model.h"
#include "coupling/sphere_model.h"

using namespace windhover;
using namespace windhover::coupling;

namespace {

/// A quadcopter whose controller takes samples at 100 Hz, with a setpoint that jumps between two of them.
VehicleModel flyer() {
  VehicleModel m = QuadcopterModel::vehicle();
  m.controller.rate_hz = 100;
  m.controller.cascade.rate_filter_s = 0.02;
  m.controller.plan = {{.time_s = 0}, {.time_s = 0.0234, .position_m = {1, 0, 0}}};
  m.integrator = {.relative_tolerance = 1e-10, .absolute_tolerance = 1e-12};
  return m;
}

body::LoadPolynomial loads(const Window& window, double t0, double t1) {
  VectorXd a = VectorXd::Zero(window.interface_size()), b = a;
  a.head<6>() << 0.1, 19, -0.2, 0.01, 0.02, -0.01;
  b.head<6>() << 0.3, 21, 0.1, -0.02, 0.01, 0.03;
  return body::LoadPolynomial({{t0, a}, {t1, b}});
}

double distance(const VehicleState& a, const VehicleState& b) {
  return (VectorXd::Map(a.y.data(), a.y.size()) - VectorXd::Map(b.y.data(), b.y.size())).lpNorm<Eigen::Infinity>();
}

/// Answers like the sphere's air, and writes down what it is asked.
class RecordingAir : public AcousticSphere {
 public:
  using AcousticSphere::AcousticSphere;
  VectorXd loads(const VehicleState& vehicle) override {
    calls += "l";
    return AcousticSphere::loads(vehicle);
  }
  void begin(const Trajectory& motion, double dt) override {
    calls += "b";
    start = motion(0);
    AcousticSphere::begin(motion, dt);
  }
  Answer iterate(const Trajectory& motion, int newton) override {
    calls += "i";
    CHECK(motion(0).y == start.y);  // the start of the step does not move
    middle = motion(0.5);
    end = motion(1);
    if (fail_at-- == 0) return {.converged = false, .failed = true, .reason = "vacuum", .loads = {}};
    return AcousticSphere::iterate(motion, newton);
  }
  void accept() override {
    calls += "a";
    AcousticSphere::accept();
  }
  std::string calls;
  VehicleState start, middle, end;
  int fail_at = -1;
};

}  // namespace

TEST_CASE("window: the outcome depends on the state alone, a copy restores it, parts make the whole", "[coupling]") {
  const Window window(flyer());
  const auto load = loads(window, 0, 0.05);
  const VehicleState start = window.start(), saved = start;
  const VehicleState whole = window.advance(start, load, 0.05);
  CHECK(start.y == saved.y);  // advancing does not touch what it started from
  CHECK(start.sampled.next_sample == saved.sampled.next_sample);
  CHECK(window.advance(start, loads(window, 0, 0.01), 0.02).y != whole.y);
  const VehicleState again = window.advance(saved, load, 0.05);
  CHECK(again.y == whole.y);
  CHECK(again.sampled.state == whole.sampled.state);
  CHECK(again.sampled.held.rotor_speed == whole.sampled.held.rotor_speed);
  CHECK(whole.sampled.next_sample == 5);  // at 0, 0.01, ... 0.04; that at 0.05 belongs to the next window

  for (const double split : {0.01, 0.0234, 0.0317}) {
    const VehicleState middle = window.advance(start, load, split), end = window.advance(middle, load, 0.05);
    CAPTURE(split);
    CHECK(distance(end, whole) < 1e-7);
    CHECK(end.sampled.next_sample == whole.sampled.next_sample);
  }
}

TEST_CASE("window: events are samples and setpoints, each once", "[coupling]") {
  const Window window(flyer());
  VehicleState s = window.start();
  for (const double expected : {0.01, 0.02, 0.0234, 0.03, 0.04}) {
    CHECK(window.next_event(s) == Approx(expected).epsilon(1e-14));
    s.t = window.next_event(s);
  }
  s.t = std::nextafter(0.05, 0);  // as rounding leaves it
  CHECK(window.next_event(s) == Approx(0.06).epsilon(1e-14));
  VehicleModel continuous = flyer();
  continuous.controller.rate_hz = 0;
  const Window smooth(continuous);
  s = smooth.start();
  CHECK(smooth.next_event(s) == 0.0234);
  s.t = 0.0234;
  CHECK(smooth.next_event(s) == std::numeric_limits<double>::infinity());
}

TEST_CASE("window: loads that move something: six and torque-driven rotors, not those on servo motors", "[coupling]") {
  VehicleModel model = flyer();
  model.vehicle.rotor[2].motor = {
      .kind = "torque", .torque_constant_Nm_A = 0.01, .resistance_ohm = 0.1, .supply_V = 12};
  const Window window(model);
  const auto responds = window.responding_loads(window.start());
  REQUIRE(responds.size() == 10);
  CHECK(responds.head(6).all());
  CHECK(responds.tail(4).count() == 1);
  CHECK(responds[8]);
}

TEST_CASE("window: a motor that goes off leaves its rotor to the air, and the body what the air does to the rotor",
          "[coupling]") {
  VehicleModel model = flyer();
  model.controller.rate_hz = 0;
  model.vehicle.rotor[1].off_at_s = 0.013;
  const Window window(model);
  VehicleState s = window.start();
  CHECK(window.next_event(s) == 0.013);
  VectorXd x = VectorXd::Zero(window.interface_size());
  x[body::LoadLayout::rotor + 1] = -0.2;
  const body::LoadPolynomial load({{0, x}});
  CHECK_FALSE(window.responding_loads(s)[body::LoadLayout::rotor + 1]);
  s = window.advance(s, load, 0.013);
  const auto absolute = [&] {
    return window.rotor_speed(s, 1) +
           window.kinematics(s).omega_WB_B.dot(window.vehicle().vehicle().rotors[1].spin_axis_B);
  };
  const double before = absolute();
  CHECK(window.responding_loads(s)[body::LoadLayout::rotor + 1]);
  s = window.advance(s, load, 0.04);
  const double slowed = -0.2 / model.vehicle.rotor[1].inertia_kg_m2 * (0.04 - 0.013);
  CHECK(absolute() - before == Approx(slowed).epsilon(1e-5));
  CHECK(window.rotor_speed(window.advance(window.start(), load, 0.05), 1) ==
        Approx(window.rotor_speed(window.advance(s, load, 0.05), 1)).epsilon(1e-6));
}

TEST_CASE("a step begins once, iterates, and is accepted once; the air sees the motion that is accepted",
          "[coupling]") {
  const SphereCase sphere{.mass = 5, .stiffness = 5};
  const Window window(sphere.model());
  RecordingAir air(window);
  CouplingOptions options;
  CoupledStep step(window, air, options, {.length = 1, .force = 1e-9});
  step.start();
  CHECK(air.calls == "l");
  for (int i = 1; i <= 3; ++i) {
    air.calls.clear();
    const VehicleState before = step.state().vehicle;
    const StepResult result = step.advance(0.1 * i);
    REQUIRE(result.accepted);
    CHECK(air.calls == "b" + std::string(result.iterations.size(), 'i') + "a");
    CHECK(air.start.y == before.y);
    CHECK(air.middle.t == Approx(0.1 * i - 0.05));
    CHECK(air.end.y == step.state().vehicle.y);
    CHECK(step.state().vehicle.t == 0.1 * i);
    CHECK(step.state().loads.back().t == 0.1 * i);
  }
}

TEST_CASE(
    "a step that is refused leaves vehicle, loads and air as they were, and a smaller one follows as if it had not been",
    "[coupling]") {
  const SphereCase sphere{.mass = 5, .stiffness = 5};
  const Window window(sphere.model());
  RecordingAir air(window), undisturbed_air(window);
  CouplingOptions options;
  options.acceleration = "aitken";
  CoupledStep step(window, air, options, {.length = 1, .force = 1e-9});
  CoupledStep undisturbed(window, undisturbed_air, options, {.length = 1, .force = 1e-9});
  for (CoupledStep* s : {&step, &undisturbed}) {
    s->start();
    REQUIRE(s->advance(0.1).accepted);
  }
  const auto before = step.pack();
  for (const int fail_at : {0, 1}) {
    air.calls.clear();
    air.fail_at = fail_at;
    const StepResult result = step.advance(0.2);
    CHECK_FALSE(result.accepted);
    CHECK(result.reason == "vacuum");
    CHECK(air.calls == "b" + std::string(fail_at + 1, 'i'));  // nothing is accepted
    CHECK(step.pack() == before);
  }
  air.fail_at = -1;
  REQUIRE(step.advance(0.15).accepted);
  REQUIRE(undisturbed.advance(0.15).accepted);
  CHECK(step.pack() == undisturbed.pack());
}

TEST_CASE("a step too large for step_tolerance is refused after it is solved, with its error", "[coupling]") {
  const SphereCase sphere{.mass = 5, .stiffness = 5};
  const Window window(sphere.model());
  RecordingAir air(window);
  CouplingOptions options;
  options.step_tolerance = 1e-3;
  CoupledStep step(window, air, options, {.length = 1, .force = 1e-9});
  step.start();
  for (int i = 1; i <= 4; ++i) REQUIRE(step.advance(0.01 * i).accepted);
  const auto before = step.pack();
  air.calls.clear();
  const StepResult result = step.advance(1.04);
  CHECK_FALSE(result.accepted);
  REQUIRE(result.error);
  CHECK(*result.error > options.step_tolerance);
  CHECK(result.reason.find("step_tolerance") != std::string::npos);
  CHECK(air.calls.find('a') == std::string::npos);
  for (const Iteration& iteration : result.iterations) CHECK_FALSE(iteration.accepted);
  CHECK(step.state().vehicle.t == before[0]);
  CHECK(step.advance(0.05).accepted);
}
