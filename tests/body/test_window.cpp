// Windows of CVODE: repeatable, of the expected order with polynomial loads, honest about failures. Motors.
#include "base/errors.h"
#include "body_fixture.h"

using namespace windhover;
using namespace windhover::body;

namespace {

Eigen::VectorXd loads_at(double t) {
  return (Eigen::VectorXd(7) << std::sin(3 * t), std::exp(-t), t * t, 0.01 * std::cos(5 * t), 0.02 * t,
          0.01 * std::sin(4 * t), -0.003 * (1 + std::sin(t)))
      .finished();
}

VehicleOptions quad_like() {
  VehicleOptions o = brick();
  o.rotation_rate_rad_s = Vec3(0.4, -0.2, 0.6);
  o.rotor.push_back(rotor("r", Vec3::UnitY(), 1e-4, "torque"));
  o.rotor[0].speed_rad_s = 300;
  return o;
}

}  // namespace

TEST_CASE("load polynomials pass through their points and reproduce their degree") {
  const auto value = [](double t, int degree) {
    return (Eigen::VectorXd(2) << 1 + (degree > 0 ? 2 * t : 0) + (degree > 1 ? -3 * t * t : 0), 7).finished();
  };
  std::vector<LoadPolynomial::Point> points;
  for (const int degree : {0, 1, 2}) {
    points.clear();
    for (int i = 0; i <= degree; ++i) points.push_back({0.2 + 0.3 * i, value(0.2 + 0.3 * i, degree)});
    const LoadPolynomial polynomial(points);
    for (const double t : {-0.4, 0.2, 0.5, 1.7}) CHECK((polynomial.at(t) - value(t, degree)).norm() < 1e-13);
  }
}

TEST_CASE("constant, linear and quadratic loads over a window are of order 1, 2 and 3") {
  const VehicleOde ode(build_vehicle(quad_like()));
  const std::vector<double> command{400};
  const Integrator integrator(tight());
  const auto final_state = [&](int steps, int degree) {
    std::vector<double> y = ode.initial_state();
    const double dt = 1.0 / steps;
    for (int i = 0; i < steps; ++i) {
      const double t = i * dt;
      std::vector<LoadPolynomial::Point> points{{t, loads_at(t)}};
      if (degree > 0) points.push_back({t + dt, loads_at(t + dt)});
      if (degree > 1) points.insert(points.begin(), {t - dt, loads_at(t - dt)});
      const LoadPolynomial loads(points);
      integrator.advance(vehicle_ode(ode, loads, command), t, t + dt, y);
    }
    return Eigen::VectorXd(Eigen::VectorXd::Map(y.data(), ode.size()));
  };
  const Ode exact{.derivative =
                      [&](double t, auto y, auto rate) {
                        const Eigen::VectorXd loads = loads_at(t);
                        ode.derivative(t, y, {loads.data(), 7}, command, rate);
                      },
                  .project = {}};
  std::vector<double> reference = ode.initial_state();
  integrator.advance(exact, 0, 1, reference);
  const Eigen::VectorXd expected = Eigen::VectorXd::Map(reference.data(), ode.size());
  for (const int degree : {0, 1, 2}) {
    const double coarse = (final_state(20, degree) - expected).norm();
    const double fine = (final_state(40, degree) - expected).norm();
    const double order = std::log2(coarse / fine);
    INFO("degree " << degree << ": error " << coarse << " then " << fine << ", order " << order);
    CHECK(order > degree + 0.9);
    CHECK(order < degree + 1.3);
  }
}

TEST_CASE("a window repeats bit for bit, whatever the integrator did before") {
  const VehicleOde ode(build_vehicle(quad_like()));
  const std::vector<double> command{400};
  const LoadPolynomial loads({{0.1, loads_at(0.1)}, {0.13, loads_at(0.13)}});
  const LoadPolynomial other({{0.1, 5 * loads_at(0.7)}});
  for (const std::string method : kMethods) {
    const IntegratorOptions options{.method = method};
    const Integrator used(options);
    std::vector<double> saved = ode.initial_state();
    used.advance(vehicle_ode(ode, other, command), 0, 0.1, saved);
    std::vector<double> first = saved, second = saved, disturbed = saved, elsewhere = saved;
    used.advance(vehicle_ode(ode, loads, command), 0.1, 0.13, first);
    used.advance(vehicle_ode(ode, other, command), 0.1, 0.2, disturbed);
    used.advance(vehicle_ode(ode, loads, command), 0.1, 0.13, second);
    Integrator(options).advance(vehicle_ode(ode, loads, command), 0.1, 0.13, elsewhere);
    CHECK(first == second);
    CHECK(first == elsewhere);
    CHECK(disturbed != first);
  }
}

TEST_CASE("a window as short as round-off is no error") {
  const VehicleOde ode(build_vehicle(quad_like()));
  std::vector<double> y = ode.initial_state();
  const std::vector<double> before = y;
  fly(ode, 0.6, std::nextafter(0.6, 1), y, {}, {400});
  CHECK((Eigen::VectorXd::Map(y.data(), ode.size()) - Eigen::VectorXd::Map(before.data(), ode.size())).norm() < 1e-12);
}

TEST_CASE("the quaternion keeps unit length over many windows") {
  const VehicleOde ode(build_vehicle(quad_like()));
  for (const std::string method : kMethods) {
    std::vector<double> y = ode.initial_state();
    double worst = 0;
    for (int i = 0; i < 500; ++i) {
      fly(ode, i * 0.02, (i + 1) * 0.02, y, {.method = method, .relative_tolerance = 1e-6}, {400});
      worst = std::max(worst, std::abs(Vec4::Map(&y[3]).norm() - 1));
    }
    CHECK(worst < 1e-15);
  }
}

TEST_CASE("within a window BDF's projection keeps the quaternion's length from drifting") {
  const VehicleOde ode(build_vehicle(quad_like()));
  const LoadPolynomial loads = no_loads(ode);
  const std::vector<double> command{400};
  const auto largest_correction = [&](const std::string& method) {
    double largest = 0;
    Ode problem = vehicle_ode(ode, loads, command);
    problem.project = [&](std::span<double> y) {
      largest = std::max(largest, std::abs(Vec4::Map(&y[3]).norm() - 1));
      ode.project(y);
    };
    std::vector<double> y = ode.initial_state();
    Integrator({.method = method, .relative_tolerance = 1e-6, .absolute_tolerance = 1e-8}).advance(problem, 0, 100, y);
    return largest;
  };
  const double each_step = largest_correction("bdf"), at_the_end = largest_correction("adams");
  INFO("largest correction of the length: bdf " << each_step << ", adams " << at_the_end);
  CHECK(each_step < 1e-5);
  CHECK(at_the_end < 1e-2);
  CHECK(each_step < 0.1 * at_the_end);
}

TEST_CASE("an exception in the right-hand side comes back, the state untouched; too many steps are a SolverFailure") {
  const Integrator integrator({.max_steps = 20});
  std::vector<double> y{1, 2};
  const Ode failing{.derivative =
                        [](double t, auto, auto) {
                          if (t > 0.1) throw UserError("wind: no such place");
                        },
                    .project = {}};
  CHECK_THROWS_WITH(integrator.advance(failing, 0, 1, y), "wind: no such place");
  const Ode stiff{.derivative = [](double t, auto, auto rate) { rate[0] = std::sin(1e6 * t), rate[1] = 0; },
                  .project = {}};
  CHECK_THROWS_AS(integrator.advance(stiff, 0, 1, y), SolverFailure);
  const Ode broken{.derivative = [](double, auto, auto rate) { rate[0] = std::nan(""), rate[1] = 0; }, .project = {}};
  CHECK_THROWS_AS(integrator.advance(broken, 0, 1, y), SolverFailure);
  CHECK(y == std::vector<double>{1, 2});
}

TEST_CASE("a torque-driven rotor spins up and is slowed by the air as the exact exponential says") {
  VehicleOptions o = brick();
  lock_all(o.mount);
  o.rotor.push_back(rotor("r", Vec3::UnitY(), 2e-4, "torque"));
  o.rotor[0].speed_rad_s = 60;
  o.rotor[0].motor.friction_Nm = 0.004;
  o.rotor[0].motor.friction_Nm_s = 2e-5;
  const VehicleOde ode(build_vehicle(o));
  const double kt = 0.01, resistance = 0.1, air = -0.05;
  Eigen::VectorXd values = Eigen::VectorXd::Zero(7);
  values[LoadLayout::rotor] = air;
  const LoadPolynomial loads({{0, values}});
  for (const double command : {500.0, 5000.0}) {  // the second asks for more than the supply gives
    std::vector<double> y = ode.initial_state();
    const std::vector<double> commands{command};
    Integrator(tight()).advance(vehicle_ode(ode, loads, commands), 0, 0.2, y);
    const double slope = kt * kt / resistance + 2e-5;
    const double end = (kt / resistance * std::min(kt * command, 12.0) + air - 0.004) / slope;
    const double expected = end + (60 - end) * std::exp(-slope / 2e-4 * 0.2);
    CHECK(y[0] == Approx(expected).epsilon(1e-9));
  }
}

TEST_CASE("a governor holds the speed that is commanded; without one a load slows the rotor") {
  const TorqueMotor free{0.01, 0.1, 12, 0, 0, 0}, governed{0.01, 0.1, 12, 0, 0, 0.5};
  const auto loaded_speed = [](const TorqueMotor& motor) {
    double speed = 0;
    for (int i = 0; i < 100000; ++i) speed += 1e-4 / 2e-4 * (motor.torque(500, speed) - 0.1);
    return speed;
  };
  CHECK(loaded_speed(free) == Approx(400).epsilon(1e-6));
  CHECK(loaded_speed(governed) == Approx(500).epsilon(0.005));
}

TEST_CASE("motors: the command that holds a speed holds it", "[body]") {
  const TorqueMotor motor{.torque_constant = 0.01, .resistance = 0.1, .supply = 12, .friction = 2e-3, .viscous_friction = 1e-5, .governor = 0.02};
  const double speed = 400, air = -0.06;
  CHECK(motor.torque(motor.holding(speed, air), speed) + air == Approx(0).margin(1e-15));
  CHECK(ServoMotor{0.03}.acceleration(ServoMotor{0.03}.holding(speed, air), speed) == 0);
}
