// Trim without a flow: the solver alone, then vehicles whose air is a formula.
#include "base/errors.h"
#include "coupling/quadcopter_model.h"

using namespace windhover;
using namespace windhover::coupling;

namespace {

/// x² + y² = 5, x y = 2: solved by (1, 2), far from linear; the second column of the model is left to a difference.
class Circle : public BalanceProblem {
 public:
  std::optional<VectorXd> evaluate(const VectorXd& u) override {
    x_ = u;
    return Eigen::Vector2d(u.squaredNorm() - 5, u[0] * u[1] - 2);
  }
  MatrixXd model_jacobian() override { return (MatrixXd(2, 2) << 2 * x_[0], 0, x_[1], 0).finished(); }

 private:
  VectorXd x_;
};

}  // namespace

TEST_CASE("balance solver: a nonlinear system, a column by difference", "[trim]") {
  Circle circle;
  const BalanceResult result =
      solve_balance(circle, Eigen::Vector2d(1.2, 2.4), {.tolerance = 1e-9, .max_evaluations = 30});
  INFO(result.reason);
  REQUIRE(result.converged);
  CHECK((result.u - Eigen::Vector2d(1, 2)).norm() < 1e-8);
  CHECK(result.evaluations < 15);
}

TEST_CASE("balance solver: what does not converge is told", "[trim]") {
  Circle circle;
  BalanceResult result = solve_balance(circle, Eigen::Vector2d(1.2, 2.4), {.tolerance = 1e-9, .max_evaluations = 4});
  CHECK_FALSE(result.converged);
  CHECK(result.evaluations == 4);
  CHECK(result.reason == "no balance after 4 tries");
  result = solve_balance(circle, Eigen::Vector2d(1, 2), {});
  CHECK(result.converged);
  CHECK(result.evaluations == 1);
}

TEST_CASE("trim of a quadcopter in wind: accelerations vanish, few evaluations, whatever the noise", "[trim]") {
  const Window window(QuadcopterModel::vehicle());
  const double noise = GENERATE(0.0, 2e-4, 1e-3), wind = GENERATE(0.0, 2.0, 5.0, 10.0);
  const Equilibrium equilibrium(window, {}, 0.56);
  CHECK(equilibrium.unknowns() ==
        std::vector<std::string>{"rotation_x", "rotation_z", "front_right", "front_left", "rear_right", "rear_left"});
  ModelTrim trim(window, equilibrium, {.wind_W = Vec3(-wind, 0, 0)}, noise);
  const BalanceResult result =
      solve_balance(trim, equilibrium.scaled_unknowns(equilibrium.hold(window.start())), equilibrium.solver_options());
  INFO(result.reason);
  REQUIRE(result.converged);
  CAPTURE(noise, wind);
  CHECK(result.evaluations <= 4);
  // the vehicle's own equations of motion, which the trim does not use
  const VehicleState state = equilibrium.state(0, trim.hold());
  std::vector<double> rate(state.y.size());
  const std::vector<double> command(trim.hold().rotor_speed.begin(), trim.hold().rotor_speed.end());
  window.vehicle().derivative(0, state.y, {trim.mean().loads.data(), 10}, command, rate);
  const int speeds = window.vehicle().vehicle().mount.position_size();
  const double g = 9.80665, allowed = 2e-3 + noise;
  CHECK(Vec3::Map(&rate[speeds]).lpNorm<Eigen::Infinity>() < 1.001 * allowed * g);
  CHECK(std::abs(rate[speeds + 5]) < 1.001 * allowed * g * std::sqrt(1.72 * 0.0313) / 0.0173);
  const double pitch = trim.hold().coordinates[5];
  if (wind >= 5) CHECK(pitch < -0.01);  // nose down, against the wind
  CHECK(std::abs(trim.hold().coordinates[3]) < 0.01);
}

namespace {

/// What the trim's keys make of the quadcopter, or of what `change` makes of it.
std::string refusal(const TrimOptions& options, const std::function<void(body::VehicleOptions&)>& change = {}) {
  VehicleModel model = QuadcopterModel::vehicle();
  model.controller.kind = "none";
  for (const auto& rotor : model.vehicle.rotor) model.controller.speed_rad_s[rotor.name] = 400;
  if (change) change(model.vehicle);
  const Window window(model);
  try {
    Equilibrium(window, options, 0.56);
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("trim: unknowns and balances that cannot be", "[trim]") {
  using Catch::Contains;
  using Options = body::VehicleOptions;
  CHECK(refusal({}) == "");
  CHECK_THAT(refusal({.unknowns = {"rotation_z", "front_right"}}),
             Contains("trim.unknowns: 2 (\"rotation_z\", \"front_right\") for 6"));
  CHECK_THAT(refusal({.unknowns = {"front_rigth"}}),
             Contains("trim.unknowns: no \"front_rigth\" (did you mean \"front_right\"?)"));
  CHECK_THAT(refusal({.unknowns = {"rotation_z", "rotation_z"}}), Contains("trim.unknowns: \"rotation_z\" twice"));
  CHECK_THAT(refusal({.unknowns = {"y"}}), Contains("trim.unknowns: \"y\" is free and on no spring"));
  CHECK_THAT(refusal({.balance = {"front_right"}}), Contains("trim.balance: no \"front_right\""));
  CHECK_THAT(refusal({}, [](Options& o) { o.rotor[2].speed_rad_s = 0; }), Contains("body.rotor[2].speed_rad_s: is 0"));
  CHECK_THAT(refusal({}, [](Options& o) { o.gravity_m_s2.setZero(); }), Contains("trim.force_scale_N: is needed"));
  CHECK_THAT(refusal({}, [](Options& o) { o.rotation_rate_rad_s.x() = 1; }),
             Contains("body.rotation_rate_rad_s: is not zero for rotation_x"));
  const auto lock_pitch = [](Options& o) { o.mount.rotation_z.kind = "locked"; };
  CHECK_THAT(refusal({.unknowns = {"rotation_z"}}, lock_pitch),
             Contains("trim.unknowns: \"rotation_z\" is held by body.mount.rotation_z"));
  CHECK_THAT(refusal({.balance = {"rotation_z"}}, lock_pitch),
             Contains("trim.balance: \"rotation_z\" is held by body.mount.rotation_z"));
  CHECK_THAT(refusal({}, [](Options& o) { o.mount.x.kind = "prescribed", o.mount.x.amplitude = 1; }),
             Contains("body.mount.x: is prescribed to oscillate"));
  CHECK_THAT(refusal({},
                     [](Options& o) {
                       for (body::FreedomOptions* f : std::initializer_list<body::FreedomOptions*>{
                                &o.mount.x, &o.mount.y, &o.mount.z, &o.mount.rotation_x, &o.mount.rotation_y,
                                &o.mount.rotation_z})
                         f->kind = "locked";
                     }),
             Contains("trim.balance: body.mount leaves the body no motion"));
}

TEST_CASE("trim: states of a vehicle and unknowns are each other's inverse", "[trim]") {
  const Window window(QuadcopterModel::vehicle());
  const Equilibrium equilibrium(window, {}, 0.56);
  const VectorXd u = (VectorXd(6) << 0.3, -0.7, 4, 5, 6, 7).finished();
  const VehicleState state = equilibrium.state(3, equilibrium.hold(u));
  CHECK((equilibrium.scaled_unknowns(equilibrium.hold(state)) - u).norm() < 1e-12);
}

TEST_CASE("trim of a body on springs: exact where the air is constant, its own weight included", "[trim]") {
  VehicleModel model;
  model.vehicle.mass_kg = 2;
  model.vehicle.inertia_kg_m2 = Vec3(1, 1, 1);
  model.vehicle.mount.point_m = Vec3(0.1, 0, 0);
  for (body::FreedomOptions* f :
       std::initializer_list<body::FreedomOptions*>{&model.vehicle.mount.x, &model.vehicle.mount.z,
                                                    &model.vehicle.mount.rotation_x, &model.vehicle.mount.rotation_y})
    f->kind = "locked";
  model.vehicle.mount.y = {{.kind = "spring", .stiffness = 500}};
  model.vehicle.mount.rotation_z = {{.kind = "spring", .stiffness = 40}};
  const Window window(model);
  const Equilibrium equilibrium(window, {.tolerance = 1e-10}, 1);
  struct Constant : BalanceProblem {
    const Equilibrium& equilibrium;
    Hold hold;
    VectorXd loads = (VectorXd(6) << 1, 30, 0, 0, 0, 2).finished();
    explicit Constant(const Equilibrium& e) : equilibrium(e) {}
    std::optional<VectorXd> evaluate(const VectorXd& u) override {
      return equilibrium.residual(hold = equilibrium.hold(u), loads);
    }
    MatrixXd model_jacobian() override { return equilibrium.model_jacobian(hold, {loads, {}}); }
  } problem(equilibrium);
  const BalanceResult result = solve_balance(problem, VectorXd::Zero(2), equilibrium.solver_options());
  REQUIRE(result.converged);
  const double force = 30 - 2 * 9.80665, angle = problem.hold.coordinates[5];
  CHECK(problem.hold.coordinates[1] == Approx(force / 500));
  // about the point, 0.1 ahead of the centre of gravity, which turns with the body
  CHECK(40 * angle == Approx(2 - 0.1 * std::cos(angle) * force + 0.1 * std::sin(angle) * 1).epsilon(1e-8));
}
