// The cascade flying a quadcopter: it settles where theory says, continuous and sampled.
#include "body/attitude.h"
#include "quadcopter.h"

using namespace windhover;
using namespace windhover::control;

namespace {

ControllerOptions cascade(double rate_hz) {
  ControllerOptions o;
  o.kind = "cascade";
  o.rate_hz = rate_hz;
  return o;
}

/// Roll, yaw (right-handed), pitch.
Vec3 angles(const ClosedLoop& loop) { return body::gimbal_angles(loop.measure().R_WB); }

}  // namespace

TEST_CASE("hover: at rest in place, every rotor at its speed of theory") {
  const double rate_hz = GENERATE(0.0, 250.0);
  const Airframe airframe = quadcopter();
  ClosedLoop loop(airframe, cascade(rate_hz));
  loop.y[7] = 0.3, loop.y[8] = -0.2, loop.y[10] = 1;  // pushed: velocity and angular velocity
  loop.advance(20);
  const Measurement m = loop.measure();
  CHECK(m.p_WoG_W.norm() < 1e-3);
  CHECK(m.v_WG_W.norm() < 1e-3);
  CHECK(m.omega_WB_B.norm() < 1e-3);
  for (int j = 0; j < 4; ++j) CHECK(loop.rotor_speed(j) == Approx(hover_speed(airframe)).epsilon(1e-3));
}

TEST_CASE("position and yaw steps: little overshoot, and there in the end") {
  const double rate_hz = GENERATE(0.0, 250.0);
  ControllerOptions o = cascade(rate_hz);
  o.plan = {{.time_s = 0}, {.time_s = 1, .position_m = Vec3(2, 1, -1), .yaw_deg = 60}};
  ClosedLoop loop(quadcopter(), o);
  loop.advance(1);
  CHECK(loop.measure().p_WoG_W.norm() < 1e-3);
  Vec3 farthest = Vec3::Zero();
  double largest_yaw = 0;
  for (int i = 0; i < 140; ++i) {
    loop.advance(1 + 0.1 * (i + 1));
    farthest = farthest.cwiseMax(loop.measure().p_WoG_W.cwiseQuotient(Vec3(2, 1, -1)));
    largest_yaw = std::max(largest_yaw, -angles(loop).y() * 180 / kPi);
  }
  INFO("largest over the target: x, y, z " << farthest.transpose() << ", yaw " << largest_yaw / 60);
  CHECK((loop.measure().p_WoG_W - Vec3(2, 1, -1)).norm() < 5e-3);
  CHECK(-angles(loop).y() * 180 / kPi == Approx(60).margin(0.1));  // clockwise seen from above
  CHECK(farthest.maxCoeff() < 1.25);
  CHECK(largest_yaw < 60 * 1.15);
}

TEST_CASE("headwind: it holds its place, nose down by atan(drag / weight)") {
  const Airframe airframe = quadcopter();
  ClosedLoop loop(airframe, cascade(0));
  loop.wind_W = Vec3(-5, 0, 0);
  loop.drag_area = 0.1;
  loop.advance(25);
  const double drag = 0.5 * kDensity * 0.1 * 25, weight = airframe.mass * kGravity;
  CHECK(loop.measure().p_WoG_W.norm() < 2e-3);
  CHECK(angles(loop).z() == Approx(-std::atan(drag / weight)).epsilon(1e-3));
  const double thrust = std::hypot(drag, weight) / 4;
  for (int j = 0; j < 4; ++j)
    CHECK(loop.rotor_speed(j) == Approx(std::sqrt(thrust / airframe.rotors[j].thrust_N_s2)).epsilon(1e-3));
}

TEST_CASE("a waypoint's velocity is flown where no position is held") {
  ControllerOptions o = cascade(0);
  o.cascade.position_gain_1_s = Vec3(0, 1.5, 0);
  o.plan = {{.velocity_m_s = Vec3(5, 0, -1)}};
  ClosedLoop loop(quadcopter(), o);
  loop.drag_area = 0.1;
  loop.advance(25);
  CHECK((loop.measure().v_WG_W - Vec3(5, 0, -1)).norm() < 5e-3);
  CHECK(std::abs(loop.measure().p_WoG_W.y()) < 2e-3);
}

TEST_CASE("saturation: a far target neither winds up the integrators nor topples the vehicle") {
  const double rate_hz = GENERATE(0.0, 250.0);
  ControllerOptions o = cascade(rate_hz);
  o.cascade.max_tilt_deg = 20;
  o.cascade.max_speed_m_s = 20;
  o.cascade.velocity_integral_1_s2 = Vec3(2, 2, 2);
  o.plan = {{.position_m = Vec3(15, 0, 0)}};
  const auto beyond = [&](double antiwindup) {
    o.cascade.antiwindup_s = antiwindup;
    ClosedLoop loop(quadcopter(), o);
    std::vector<double> path;
    for (int i = 1; i <= 150; ++i) {
      loop.advance(0.2 * i);
      path.push_back(loop.measure().p_WoG_W.x() - 15);
      CHECK(std::abs(angles(loop).z()) < 35 * kPi / 180);
    }
    return path;
  };
  const std::vector<double> with = beyond(0.2), without = beyond(1e6);
  const double overshoot = *std::max_element(with.begin(), with.end());
  INFO("overshoot " << overshoot << " m with anti-windup, " << *std::max_element(without.begin(), without.end())
                    << " m without");
  CHECK(overshoot < 0.1);
  CHECK(std::abs(with.back()) < 1e-3);
  CHECK(*std::max_element(without.begin(), without.end()) > 10);
}

TEST_CASE("saturated rotors: a yaw that they cannot give at once is reached without wind-up") {
  ControllerOptions o = cascade(0);
  o.cascade.rate_gain_1_s = Vec3(20, 40, 20);
  o.cascade.rate_integral_1_s2 = Vec3(20, 60, 20);
  o.cascade.max_rate_deg_s = Vec3(220, 400, 220);
  o.plan = {{.yaw_deg = 170}};
  ClosedLoop loop(quadcopter(), o);
  double largest = 0;
  for (int i = 1; i <= 80; ++i) {
    loop.advance(0.1 * i);
    const double yaw = -angles(loop).y() * 180 / kPi;
    largest = std::max(largest, yaw < -90 ? yaw + 360 : yaw);
    CHECK(std::abs(loop.measure().p_WoG_W.y()) < 0.2);  // height is not given up for yaw
  }
  INFO("largest yaw " << largest);
  CHECK(-angles(loop).y() * 180 / kPi == Approx(170).margin(0.5));
  CHECK(largest < 190);
}

TEST_CASE("a sampled controller sees its samples exactly at their times, whatever the steps of the solver") {
  const ControllerOptions o = cascade(400);
  ClosedLoop coarse(quadcopter(), o), fine(quadcopter(), o);
  std::vector<double> coarse_times, fine_times;
  const double end = 0.1;
  coarse.y[7] = fine.y[7] = 0.5;
  coarse.advance(end, [&](double t) { coarse_times.push_back(t); });
  for (int i = 1; i <= 37; ++i) fine.advance(end * i / 37, [&](double t) { fine_times.push_back(t); });
  REQUIRE(coarse_times.size() == 40);
  for (int k = 0; k < 40; ++k) CHECK(coarse_times[k] == k / 400.0);
  CHECK(coarse_times == fine_times);
  for (std::size_t i = 0; i < coarse.y.size(); ++i) CHECK(fine.y[i] == Approx(coarse.y[i]).margin(1e-5));
}

TEST_CASE("a step with a sampled controller repeats bit for bit from what was saved") {
  ClosedLoop loop(quadcopter(), cascade(400));
  loop.y[7] = 0.5;
  loop.advance(0.033);
  const double time = loop.time;
  const SampledState sampled = loop.sampled;
  const std::vector<double> y = loop.y;
  loop.advance(0.0511);
  const std::vector<double> first = loop.y;
  loop.time = time, loop.sampled = sampled, loop.y = y;
  loop.advance(0.0511);
  CHECK(loop.y == first);
}

TEST_CASE("more samples approach the continuous controller, first order in the interval") {
  const auto height = [](double rate_hz) {
    ControllerOptions o = cascade(rate_hz);
    o.plan = {{.position_m = Vec3(0, 1, 0)}};
    ClosedLoop loop(quadcopter(), o);
    loop.advance(0.5);
    return loop.measure().p_WoG_W.y();
  };
  const double exact = height(0), coarse = height(250) - exact, fine = height(500) - exact;
  INFO("errors " << coarse << ", " << fine);
  CHECK(coarse / fine == Approx(2).margin(0.4));
}

TEST_CASE("cascade: the states for a command give it, and stay", "[control]") {
  const Airframe airframe = quadcopter();
  ControllerOptions options;
  options.kind = "cascade";
  const auto controller = make_controller(options, airframe);
  Measurement m;
  m.R_WB = Eigen::AngleAxisd(-0.15, Vec3::UnitZ()).toRotationMatrix();
  const Command command{{430, 425, 470, 475}};
  const std::vector<double> state = controller->state_for(m, {}, command);
  std::vector<double> rate(state.size());
  const Command given = controller->evaluate(m, {}, state, rate);
  for (int j = 0; j < 4; ++j) CHECK(given.rotor_speed[j] == Approx(command.rotor_speed[j]).epsilon(1e-12));
  for (const double r : rate) CHECK(std::abs(r) < 1e-10);
}
