// Step sizes: the error follows the tolerance, steps end at events, and a restart goes on with the same steps.
#include "coupling/sphere_model.h"
#include "coupling/step_control.h"

using namespace windhover;
using namespace windhover::coupling;

namespace {

constexpr double kLargest = 2;

CouplingOptions adaptive(double tolerance) {
  CouplingOptions o;
  o.tolerance = o.pose_tolerance = 1e-10;
  o.step_tolerance = tolerance;
  return o;
}

struct AdaptiveRun {
  AdaptiveRun(const SphereCase& sphere, double tolerance) : run(sphere, adaptive(tolerance)), control(tolerance) {}

  /// One accepted step, not across `event`.
  void advance(double event) {
    const double t = run.step.state().vehicle.t;
    double dt = control.propose(kLargest, 0.01, t, event);
    for (;; ++refused) {
      const StepResult result = run.advance(dt);
      if (result.accepted) {
        control.accepted(dt, result.error, kLargest);
        break;
      }
      REQUIRE(run.step.state().vehicle.t == t);
      dt = control.refused(dt, result.error);
      REQUIRE(dt > 1e-6);
    }
    ++steps;
  }

  SphereRun run;
  StepControl control;
  int steps = 0, refused = 0;
};

VectorXd one_load(double value) { return VectorXd::Constant(1, value); }

}  // namespace

TEST_CASE("the error of linear loads is exact for quadratic ones, whatever the steps and what alternates on them",
          "[coupling]") {
  const Window::Responses all = Window::Responses::Constant(1, true);
  const double times[] = {0.1, 0.5, 0.7, 1.6, 1.9};
  std::vector<body::LoadPolynomial::Point> plain, ringing;
  for (int i = 0; i < 5; ++i) {
    const double t = times[i], value = 3 - 2 * t + 5 * t * t;
    plain.push_back({t, one_load(value)});
    ringing.push_back({t, one_load(value + (i % 2 ? 40 : -40))});
  }
  const std::span<const body::LoadPolynomial::Point> points(plain);
  const VectorXd scale = one_load(10);
  CHECK_FALSE(load_error(points.first(2), scale, all));
  CHECK(*load_error(points.first(3), scale, all) == Approx(5 * 0.2 * 0.2 / 6 / 10));
  CHECK(*load_error(points.first(4), scale, all) == Approx(5 * 0.9 * 0.9 / 6 / 10));
  CHECK(*load_error(points, scale, all) == Approx(5 * 0.3 * 0.3 / 6 / 10));
  CHECK(*load_error(ringing, scale, all) == Approx(5 * 0.3 * 0.3 / 6 / 10));
  CHECK(*load_error(points, scale, !all) == 0);
}

TEST_CASE("adaptive steps: the error of the motion follows the tolerance", "[coupling]") {
  const SphereCase sphere{.mass = 5, .stiffness = 5};
  std::vector<double> errors;
  std::vector<int> steps;
  for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-5}) {
    AdaptiveRun adaptive(sphere, tolerance);
    double largest = 0;
    while (adaptive.run.step.state().vehicle.t < 16) {
      adaptive.advance(16);
      const double t = adaptive.run.step.state().vehicle.t;
      largest = std::max(largest, std::abs(adaptive.run.displacement() - sphere.exact(t)[0]) / sphere.start);
    }
    CHECK(adaptive.run.step.state().vehicle.t == 16);
    CHECK(adaptive.refused < 0.1 * adaptive.steps + 3);
    CHECK(largest < tolerance);
    errors.push_back(largest);
    steps.push_back(adaptive.steps);
  }
  CAPTURE(errors, steps);
  for (size_t i = 1; i < errors.size(); ++i) {  // a tenth of the tolerance: a tenth of the error, 3.2 times the steps
    CHECK(errors[i - 1] / errors[i] > 5);
    CHECK(errors[i - 1] / errors[i] < 20);
  }
  CHECK(steps[3] / double(steps[1]) == Approx(10).margin(2));
}

TEST_CASE("adaptive steps end at every event", "[coupling]") {
  const SphereCase sphere{.mass = 5, .stiffness = 5};
  AdaptiveRun adaptive(sphere, 1e-3);
  int refinement = 0;
  for (const double event : {0.013, 0.013001, 0.4, 1.9, 5.0, 5.03, 8.0}) {
    for (double before = adaptive.run.step.state().vehicle.t; before < event * (1 - 1e-12); ++refinement) {
      adaptive.advance(event);
      const double now = adaptive.run.step.state().vehicle.t;
      CHECK(now <= event * (1 + 1e-15));
      before = now;
    }
    CHECK(adaptive.run.step.state().vehicle.t == Approx(event).epsilon(1e-15));
  }
  CHECK(refinement < 120);  // a sliver before an event does not make the steps after it small
}

TEST_CASE("step control: no slivers, growth by two at most, recovery after an event, the state carries on",
          "[coupling]") {
  StepControl control(1e-3);
  CHECK(control.propose(1, 0.25, 0, 100) == 0.25);
  CHECK(control.propose(1, 0.25, 0, 0.1) == 0.1);
  CHECK(control.propose(1, 0.25, 0, 0.3) == 0.15);  // two halves and not 0.25 and a sliver
  control.accepted(0.25, 1e-9, 1);
  CHECK(control.propose(1, 0.25, 0.25, 100) == 0.5);
  control.accepted(0.01, 1e-12, 1);  // cut by an event
  CHECK(control.propose(1, 0.25, 0.5, 100) == 1);
  control.accepted(1, 4e-3 / 1.0001, 1);
  CHECK(control.propose(1, 0.25, 1.5, 100) == Approx(0.4).epsilon(1e-3));
  CHECK(control.refused(1, 4e-3) == Approx(0.4));
  CHECK(control.refused(1, 1e3) == 0.2);
  CHECK(control.refused(1, {}) == 0.5);
  StepControl other(1e-3);
  other.restore(control.state());
  CHECK(other.propose(1, 0.25, 1.5, 100) == control.propose(1, 0.25, 1.5, 100));
}

TEST_CASE("equal steps halve and grow back", "[coupling]") {
  StepControl control(0);
  CHECK(control.propose(1, 1, 0, 100) == 1);
  CHECK(control.refused(1, {}) == 0.5);
  control.accepted(0.25, {}, 1);
  CHECK(control.propose(1, 1, 0.25, 100) == 0.5);
  control.accepted(0.5, {}, 1);
  CHECK(control.propose(1, 1, 0.75, 100) == 1);
  CHECK(control.propose(1, 1, 99.5, 100) == 0.5);
  CHECK(control.propose(1, 1, 98.5, 100) == 1);
}
