// The mixer as an inverse, its priorities, and what a user can get wrong about a controller.
#include <Eigen/Geometry>

#include "base/errors.h"
#include "control/control_keys.h"
#include "control/mixer.h"
#include "io/options_reader.h"
#include "quadcopter.h"

using namespace windhover;
using namespace windhover::control;
using Catch::Matchers::Contains;

namespace {

double distance(const Wrench& a, const Wrench& b) {
  return std::abs(a.thrust - b.thrust) + (a.torque_B - b.torque_B).norm();
}

std::vector<RotorModel> ring(int count, double tilt) {
  std::vector<RotorModel> rotors;
  for (int j = 0; j < count; ++j) {
    const double angle = 2 * kPi * (j + 0.3) / count;
    rotors.push_back(rotor_model(fmt::format("r{}", j), 0.3 * std::cos(angle), 0.3 * std::sin(angle), j % 2 ? 1 : -1));
    rotors.back().thrust_axis_B =
        Eigen::AngleAxisd(j % 2 ? -tilt : tilt, Vec3(std::cos(angle), 0, std::sin(angle))) * Vec3::UnitY();
  }
  return rotors;
}

}  // namespace

TEST_CASE("mixer and rotors are an inverse pair for any layout") {
  const Wrench demand{14, Vec3(0.2, -0.05, -0.3)};
  for (const auto& rotors : {quadcopter().rotors, ring(6, 0), ring(8, 0.1)}) {
    const Mixer mixer(rotors, 0.1, "mixer");
    const Allocation allocation = mixer.allocate(demand);
    CHECK(distance(allocation.achieved, demand) < 1e-12);
    const Command command = mixer.speeds(allocation.thrust);
    Eigen::VectorXd thrust(rotors.size());
    for (std::size_t j = 0; j < rotors.size(); ++j) thrust[j] = rotors[j].thrust(command.rotor_speed[j]);
    CHECK(distance(mixer.produced(thrust), demand) < 1e-12);
  }
}

TEST_CASE("signs: what each torque asks of each rotor") {
  const Mixer mixer(quadcopter().rotors, 0.1, "mixer");
  const Eigen::VectorXd hover = mixer.allocate({16, Vec3::Zero()}).thrust;
  const auto change = [&](const Vec3& torque) { return Eigen::VectorXd(mixer.allocate({16, torque}).thrust - hover); };
  const Eigen::VectorXd roll = change(Vec3(0.1, 0, 0)), yaw = change(Vec3(0, 0.05, 0)), pitch = change(Vec3(0, 0, 0.1));
  // front right, front left, rear left, rear right
  CHECK((roll.array() < 0).matrix() == Eigen::Array4<bool>(true, false, false, true).matrix());   // right wing down
  CHECK((pitch.array() > 0).matrix() == Eigen::Array4<bool>(true, true, false, false).matrix());  // nose up
  // Right-handed about y needs the air to push the airframe counter-clockwise: more from the clockwise rotors.
  CHECK((yaw.array() > 0).matrix() == Eigen::Array4<bool>(false, true, false, true).matrix());
}

TEST_CASE("under saturation yaw yields first, then roll and pitch; limits always hold") {
  const std::vector<RotorModel> rotors = quadcopter().rotors;
  const Mixer mixer(rotors, 0.1, "mixer");
  const auto within = [&](const Allocation& a) {
    for (int j = 0; j < 4; ++j) {
      CHECK(a.thrust[j] >= rotors[j].thrust(50) - 1e-12);
      CHECK(a.thrust[j] <= rotors[j].thrust(900) + 1e-12);
    }
  };
  const Allocation yaw = mixer.allocate({17, Vec3(0.3, 5, -0.4)});
  within(yaw);
  CHECK(yaw.achieved.thrust == Approx(17));
  CHECK(yaw.achieved.torque_B.x() == Approx(0.3));
  CHECK(yaw.achieved.torque_B.z() == Approx(-0.4));
  CHECK(yaw.achieved.torque_B.y() > 0);
  CHECK(yaw.achieved.torque_B.y() < 1);

  const Allocation all = mixer.allocate({1000, Vec3(20, 1, 40)});
  within(all);
  CHECK(all.achieved.thrust == Approx(0.1 * 4 * rotors[0].thrust(50) + 0.9 * 4 * rotors[0].thrust(900)));
  CHECK(all.achieved.torque_B.x() > 0);
  CHECK(all.achieved.torque_B.z() == Approx(2 * all.achieved.torque_B.x()));
  CHECK(all.achieved.torque_B.y() == Approx(0).margin(1e-9));
  within(mixer.allocate({-50, Vec3(0, 0, 1)}));
}

TEST_CASE("rotors that cannot produce a demanded axis are rejected by its name") {
  std::vector<RotorModel> no_yaw = quadcopter().rotors, on_a_line = quadcopter().rotors, sideways = quadcopter().rotors;
  for (RotorModel& r : no_yaw) r.torque_Nm_s2 = 0;
  for (RotorModel& r : on_a_line) r.p_GR_B.x() = 0;
  for (RotorModel& r : sideways) r.thrust_axis_B = Vec3::UnitX();
  CHECK_THROWS_WITH(Mixer(no_yaw, 0.1, "controller.mixer"), Contains("controller.mixer") && Contains("yaw"));
  CHECK_THROWS_WITH(Mixer(on_a_line, 0.1, "controller.mixer"), Contains("pitch"));
  CHECK_THROWS_WITH(Mixer(sideways, 0.1, "controller.mixer"), Contains("thrust along y"));
  std::vector<RotorModel> twisted = ring(6, 0);  // all tilted the same way, more than the rotors' torques can balance
  for (RotorModel& r : twisted) r.thrust_axis_B = (Vec3::UnitY() + 0.5 * r.p_GR_B.cross(Vec3::UnitY())).normalized();
  CHECK_THROWS_WITH(Mixer(twisted, 0.1, "controller.mixer"), Contains("collective"));
  std::vector<RotorModel> slow = quadcopter().rotors;
  slow[2].max_speed_rad_s = 0;
  CHECK_THROWS_WITH(Mixer(slow, 0.1, "controller.mixer"), Contains("rear_left"));
}

TEST_CASE("what a user can get wrong about a controller") {
  const Airframe airframe = quadcopter();
  const auto rejected = [&](const char* text, const char* key, const char* reason) {
    ControllerOptions o;
    try {
      const toml::table table = toml::parse(text);
      io::read_options(table, o);
      make_controller(o, airframe);
      Plan plan(o.plan);
      FAIL("accepted: " << text);
    } catch (const UserError& error) {
      CHECK_THAT(error.what(), Contains(key) && Contains(reason));
    }
  };
  rejected("kind = \"cascadee\"", "kind", "cascade");
  rejected("kind = \"cascade\"\ncascade.rate_gain_1_s = [1, 2]", "cascade.rate_gain_1_s", "");
  rejected("kind = \"cascade\"\ncascade.rate_gain_1_s = 3", "cascade.rate_gain_1_s", "");
  rejected("kind = \"cascade\"\ncascade.rate_gain_1_s = [1, 2, -3]", "cascade.rate_gain_1_s", ">= 0");
  rejected("kind = \"cascade\"\nrate_hz = 50", "cascade.rate_filter_s", "at least");
  rejected("kind = \"cascade\"\nplan = [{time_s = 1}, {time_s = 1}]", "plan[1].time_s", "later");
  rejected("kind = \"none\"\nspeed_rad_s = {front_left = 1}", "speed_rad_s", "front_right");
  rejected("speed_rad_s = {front_left = 1, front_right = 1, rear_left = 1, rear_right = 1, rear = 1}",
           "speed_rad_s.rear", "rear_left");
  ControllerOptions other;
  other.kind = "other";
  CHECK_THROWS_WITH(make_controller(other, airframe), Contains("none") && Contains("cascade"));
}

TEST_CASE("without a controller every rotor keeps the speed it is told") {
  ControllerOptions o;
  o.speed_rad_s = {{"front_left", 2}, {"front_right", 1}, {"rear_left", 3}, {"rear_right", 4}};
  CHECK(make_controller(o, quadcopter())->evaluate({}, {}, {}, {}).rotor_speed == std::vector<double>{1, 2, 3, 4});
}

TEST_CASE("a plan holds each setpoint from its time on, yaw clockwise") {
  const Plan plan({{.time_s = 1, .position_m = Vec3(1, 2, 3)}, {.time_s = 4, .yaw_deg = 90}});
  CHECK(plan.at(0).p_W == Vec3(1, 2, 3));
  CHECK(plan.at(3.999).p_W == Vec3(1, 2, 3));
  CHECK(plan.at(4).p_W == Vec3(0, 0, 0));
  CHECK(plan.at(4).yaw == Approx(-kPi / 2));
  CHECK(plan.next_change(0) == 4);
  CHECK(std::isinf(plan.next_change(4)));
}
