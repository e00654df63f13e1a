// What a user can get wrong about a vehicle: the message names the key and the reason.
#include <functional>

#include "base/errors.h"
#include "body/vehicle_keys.h"
#include "body_fixture.h"
#include "io/options_reader.h"

using namespace windhover;
using namespace windhover::body;
using Catch::Matchers::Contains;

namespace {

void check_rejected(const std::function<void(VehicleOptions&)>& spoil, const std::string& key,
                    const std::string& reason) {
  VehicleOptions o = brick();
  spoil(o);
  try {
    build_vehicle(o);
    FAIL("accepted: " << key);
  } catch (const UserError& error) {
    CHECK_THAT(error.what(), Contains(key) && Contains(reason));
  }
}

}  // namespace

TEST_CASE("impossible bodies and rotors are rejected") {
  check_rejected([](auto& o) { o.mass_kg = 0; }, "body.mass_kg", "must be > 0");
  check_rejected([](auto& o) { o.inertia_kg_m2[1] = 0; }, "body.inertia_kg_m2", "singular");
  check_rejected([](auto& o) { o.inertia_products_kg_m2 = Vec3(0.03, 0, 0); }, "body.inertia_kg_m2", "singular");
  check_rejected([](auto& o) { o.inertia_kg_m2 = Vec3(1, 1, 3); }, "body.inertia_kg_m2", "exceeds");
  check_rejected([](auto& o) { o.rotor.push_back(rotor("r", Vec3::UnitY(), 1e-4, "none")); },
                 "body.rotor[0].motor.kind", "needs a motor");
  check_rejected([](auto& o) { o.rotor.push_back(rotor("r", Vec3::Zero(), 1e-4, "servo")); }, "body.rotor[0].spin_axis",
                 "> 0");
  check_rejected([](auto& o) { o.rotor.push_back(rotor("r", Vec3::UnitY(), 1, "servo")); }, "body.inertia_kg_m2",
                 "rotors");
  check_rejected([](auto& o) { o.rotor.assign(2, rotor("r", Vec3::UnitY(), 1e-4, "servo")); }, "body.rotor[1].name",
                 "second");
  check_rejected(
      [](auto& o) {
        o.rotor.push_back(rotor("r", Vec3::UnitY(), 1e-4, "torque"));
        o.rotor[0].motor.resistance_ohm = 0;
      },
      "body.rotor[0].motor.resistance_ohm", "> 0");
}

TEST_CASE("contradictory mounts are rejected") {
  const auto mount = [](const std::string& kind, double stiffness, double amplitude) {
    return [=](VehicleOptions& o) {
      o.mount.rotation_z.kind = kind;
      o.mount.rotation_z.stiffness = stiffness;
      o.mount.rotation_z.amplitude = amplitude;
    };
  };
  check_rejected(mount("locked", 3, 0), "body.mount.rotation_z", "the axis is locked");
  check_rejected(mount("free", 3, 0), "body.mount.rotation_z", "the axis is free");
  check_rejected(mount("spring", 0, 0), "body.mount.rotation_z", "needs stiffness");
  check_rejected(mount("spring", 3, 0.1), "body.mount.rotation_z", "a motion is given");
  check_rejected(
      [](auto& o) {
        o.mount.x.kind = "locked";
        o.velocity_m_s = Vec3(1, 0, 0);
      },
      "body.mount.x", "initial velocity");
  check_rejected(
      [](auto& o) {
        o.mount.y.kind = "prescribed";
        o.position_m = Vec3(0, 1, 0);
      },
      "body.mount.y", "initial value");
  check_rejected(
      [](auto& o) {
        o.mount.rotation_z.kind = "locked";
        o.rotation_rad = Vec3(0, 0, kPi / 2);
      },
      "body.mount.rotation_z", "fall together");
}

TEST_CASE("the keys of a vehicle can be read") {
  const toml::table table = toml::parse(R"(
    mass_kg = 1.5
    inertia_kg_m2 = [0.02, 0.03, 0.02]
    mount.y = {kind = "spring", stiffness_N_m = 10.0}
    [[rotor]]
    name = "front_left"
    inertia_kg_m2 = 1e-4
    spin_axis = [0, -1, 0]
    motor = {kind = "servo", time_constant_s = 0.02}
  )");
  VehicleOptions o;
  io::read_options(table, o);
  const Vehicle vehicle = build_vehicle(o);
  CHECK(vehicle.rotors.at(0).spin_axis_B == Vec3(0, -1, 0));
  CHECK(vehicle.mount.speed_size() == 6);
  toml::table wrong = toml::parse("inertia_kg_m2 = [0.02, 0.03]");
  CHECK_THROWS_WITH(io::read_options(wrong, o), Contains("inertia_kg_m2"));
}
