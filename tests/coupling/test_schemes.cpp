// The coupling schemes on a light and a heavy sphere whose exact motion is known.
#include "base/errors.h"
#include "coupling/sphere_model.h"

using namespace windhover;
using namespace windhover::coupling;

namespace {

CouplingOptions scheme(const std::string& name, double relaxation = 1) {
  CouplingOptions o;
  const bool loose = name.starts_with("loose");
  o.scheme = loose ? name : "strong";
  if (!loose) o.acceleration = name;
  o.relaxation = relaxation;
  o.tolerance = 1e-9;
  o.pose_tolerance = 1e-9;
  return o;
}

/// Largest error of the displacement up to t = 8, over its start.
double error(const SphereCase& sphere, const CouplingOptions& options, int steps) {
  SphereRun run(sphere, options);
  double largest = 0;
  for (int i = 1; i <= steps; ++i) {
    const StepResult result = run.advance(8.0 / steps);
    INFO(result.reason);
    REQUIRE(result.accepted);
    largest = std::max(largest, std::abs(run.displacement() - sphere.exact(8.0 * i / steps)[0]));
  }
  return largest / sphere.start;
}

double order(const SphereCase& sphere, const CouplingOptions& options) {
  const double coarse = error(sphere, options, 40), medium = error(sphere, options, 80),
               fine = error(sphere, options, 160);
  CAPTURE(options.scheme, options.acceleration, coarse, medium, fine);
  CHECK(fine < medium);
  return std::log2(coarse / fine) / 2;
}

}  // namespace

TEST_CASE("order in the time step: strong 2, loose 1, extrapolated 2", "[coupling]") {
  const SphereCase sphere{.mass = 5, .stiffness = 5};
  for (const std::string name : {"constant", "aitken", "anderson", "iqn-ils"}) {
    CAPTURE(name);
    CHECK(order(sphere, scheme(name)) == Approx(2).margin(0.05));
  }
  CHECK(order(sphere, scheme("loose")) == Approx(1).margin(0.1));
  CHECK(order(sphere, scheme("loose-extrapolated")) == Approx(2).margin(0.1));
}

TEST_CASE("order of strong schemes on a body lighter than the air that moves with it", "[coupling]") {
  const SphereCase sphere{.mass = 0.2};
  for (const std::string name : {"constant", "aitken", "anderson", "iqn-ils"}) {
    CAPTURE(name);
    CHECK(order(sphere, scheme(name, 0.5)) == Approx(2).margin(0.1));
  }
}

TEST_CASE("a light sphere at steps of several a/c: strong schemes agree and are right, loose ones are lost",
          "[coupling]") {
  const SphereCase sphere{.mass = 0.2, .stiffness = 0.01};  // a period of 53 a/c
  const double dt = 3;
  const auto run = [&](const CouplingOptions& options, int* iterations = nullptr) {
    SphereRun run(sphere, options);
    double largest = 0;
    for (int i = 1; i <= 30; ++i) {
      const StepResult result = run.advance(dt);
      if (!result.accepted) return HUGE_VAL;
      if (iterations) *iterations += static_cast<int>(result.iterations.size());
      largest = std::max(largest, std::abs(run.displacement() - sphere.exact(dt * i)[0]) / sphere.start);
    }
    return largest;
  };
  CHECK_FALSE(run(scheme("loose")) < 10);
  CHECK_FALSE(run(scheme("loose-extrapolated")) < 10);
  CHECK_FALSE(run(scheme("constant", 1)) < 10);
  for (const std::string name : {"constant", "aitken", "anderson", "iqn-ils"}) {
    CouplingOptions options = scheme(name, name == "constant" ? 0.3 : 1);
    options.tolerance = options.pose_tolerance = 1e-6;
    int iterations = 0;
    const double error = run(options, &iterations);
    CAPTURE(name, error, iterations / 30.0);
    CHECK(error < 0.15);
    if (name == "anderson" || name == "iqn-ils") CHECK(iterations <= 4 * 30);
  }
}

TEST_CASE("loads on locked axes move nothing and cost no iterations", "[coupling]") {
  const SphereCase sphere{.mass = 0.2};
  for (const std::string name : {"constant", "aitken", "anderson", "iqn-ils"}) {
    CAPTURE(name);
    CouplingOptions options = scheme(name, 0.3);
    options.force_scale_N = 20;  // the same for both
    options.tolerance = 1e-11;
    SphereRun alone(sphere, options), loaded(sphere, options);
    loaded.air.side_force = 1;  // the force along x is of the order of 0.01
    const auto responds = loaded.window.responding_loads(loaded.step.state().vehicle);
    CHECK(responds[0]);
    CHECK(responds.count() == 1);
    for (int i = 0; i < 10; ++i) {
      const StepResult one = alone.advance(0.5), two = loaded.advance(0.5);
      REQUIRE(one.accepted);
      REQUIRE(two.accepted);
      CHECK(two.iterations.size() <= std::max<size_t>(one.iterations.size(), 2));
      CHECK(loaded.displacement() == Approx(alone.displacement()).margin(1e-7 * sphere.start));
      CHECK(loaded.step.state().loads.back().loads[1] == Approx((i + 1) * (i % 2 ? -1 : 1)));
    }
  }
}

TEST_CASE("aitken and anderson begin a step with the factor that the one before found", "[coupling]") {
  const SphereCase sphere{.mass = 0.2};
  for (const std::string name : {"aitken", "anderson"}) {
    CAPTURE(name);
    SphereRun run(sphere, scheme(name));
    REQUIRE(run.advance(0.5).accepted);
    const double found = run.step.pack().back();  // the scheme's state is packed last
    CHECK(found > 0.1);
    CHECK(found < 0.6);
    const StepResult second = run.advance(0.5);
    REQUIRE(second.iterations.size() > 1);
    CHECK(second.iterations[0].relaxation == found);
    CHECK(second.iterations[1].load_residual < 0.05 * second.iterations[0].load_residual);
  }
}

TEST_CASE("no step is accepted before the flow is solved", "[coupling]") {
  const SphereCase sphere{.mass = 5, .stiffness = 5};
  for (const std::string name : {"constant", "aitken", "anderson", "iqn-ils"}) {
    CAPTURE(name);
    CouplingOptions options = scheme(name);
    options.newton_per_iteration = 1;
    options.tolerance = options.pose_tolerance = 0.1;  // alone, they would be content at once
    SphereRun exact(sphere, options), inexact(sphere, options, 0.1);
    for (int i = 0; i < 20; ++i) {
      REQUIRE(exact.advance(0.1).accepted);
      const StepResult result = inexact.advance(0.1);
      REQUIRE(result.accepted);
      CHECK(result.iterations.size() >= 9);  // the model's Newton gains a digit each time
      CHECK(result.iterations.back().accepted);
      CHECK_FALSE(result.iterations[result.iterations.size() - 2].accepted);
    }
  }
}

TEST_CASE("a step without agreement is refused, and leaves everything as it was", "[coupling]") {
  const SphereCase sphere{.mass = 0.2};
  for (const std::string name : {"constant", "aitken", "anderson", "iqn-ils"}) {
    CAPTURE(name);
    CouplingOptions options = scheme(name);
    options.max_iterations = 2;
    SphereRun run(sphere, options);
    const std::vector<double> before = run.step.pack();
    const StepResult result = run.advance(0.5);
    CHECK_FALSE(result.accepted);
    CHECK(result.reason.find("2 coupling iterations") != std::string::npos);
    CHECK(result.iterations.size() == 2);
    CHECK(run.step.pack() == before);
    CHECK(run.air.iterated == 2);
  }
}

TEST_CASE("a step repeats bit for bit from what was packed", "[coupling]") {
  const SphereCase sphere{.mass = 0.2};
  for (const std::string name : {"loose-extrapolated", "aitken", "anderson", "iqn-ils"}) {
    CAPTURE(name);
    SphereRun whole(sphere, scheme(name, 0.5)), parts(sphere, scheme(name, 0.5));
    for (int i = 0; i < 7; ++i) {
      REQUIRE(whole.advance(0.1).accepted);
      REQUIRE(parts.advance(0.1).accepted);
    }
    const std::vector<double> packed = parts.step.pack();
    CoupledStep restored(parts.window, parts.air, scheme(name, 0.5), {.length = 1, .force = 1e-9});
    restored.restore(packed);
    for (int i = 0; i < 5; ++i) {
      const double end = whole.step.state().vehicle.t + 0.1;
      const StepResult one = whole.step.advance(end), two = restored.advance(end);
      REQUIRE(one.iterations.size() == two.iterations.size());
      for (size_t k = 0; k < one.iterations.size(); ++k)
        CHECK(one.iterations[k].load_residual == two.iterations[k].load_residual);
    }
    CHECK(whole.step.pack() == restored.pack());
  }
}

TEST_CASE("unknown schemes are refused by name", "[coupling]") {
  CouplingOptions options;
  options.acceleration = "newton";
  CHECK_THROWS_WITH(find_scheme(options), Catch::Contains("coupling.acceleration") && Catch::Contains("iqn-ils"));
  options.scheme = "weak";
  CHECK_THROWS_WITH(find_scheme(options), Catch::Contains("coupling.scheme") && Catch::Contains("loose-extrapolated"));
}
