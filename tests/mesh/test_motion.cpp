#include "mesh/motion.h"

#include <catch2/catch.hpp>
#include <numbers>

using namespace windhover::mesh;

namespace {

const Translation heave{.direction = Vec3(1, 2, -2) / 3, .distance = {.mean = 0.3, .rate = 0.7, .amplitude = 0.2, .omega = 3, .phase = 0.4}};
const Rotation pitch{.axis = Vec3(2, -1, 2) / 3, .point = Vec3(0.5, -0.2, 0.9), .angle = {.mean = 0.1, .amplitude = 0.6, .omega = 2, .phase = 1}};
const Rotation spin{.axis = Vec3::UnitY(), .point = Vec3(-1, 0.3, 0.2), .angle = {.rate = 5}};
const Vec3 r(0.7, -1.1, 0.4);

void check_equal(const FrameState& a, const FrameState& b) {
  CHECK((a.R - b.R).norm() < 1e-14);
  CHECK((a.x - b.x).norm() < 1e-14);
  CHECK((a.V - b.V).norm() < 1e-14);
  CHECK((a.omega - b.omega).norm() < 1e-14);
}

}  // namespace

TEST_CASE("the velocity of a point is the derivative of its position") {
  const double h = 1e-4;
  for (const Motion& motion : {Motion{heave}, Motion{pitch}, Motion{heave, pitch, spin}})
    for (const double t : {0.0, 0.37, 2.1}) {
      const auto at = [&](double time) { return evaluate(motion, time).position(r); };
      const Vec3 difference = (8 * (at(t + h) - at(t - h)) - (at(t + 2 * h) - at(t - 2 * h))) / (12 * h);
      CHECK((evaluate(motion, t).velocity(r) - difference).norm() < 1e-10);
    }
}

TEST_CASE("composition is associative and has no effect with rest") {
  const double t = 0.83;
  const FrameState a = evaluate({heave}, t), b = evaluate({pitch}, t), c = evaluate({spin}, t);
  check_equal(compose(compose(a, b), c), compose(a, compose(b, c)));
  check_equal(compose(a, FrameState{}), a);
  check_equal(compose(FrameState{}, b), b);
  check_equal(evaluate({heave, pitch, spin}, t), compose(a, compose(b, c)));
}

TEST_CASE("a rotation keeps its point and its axis fixed") {
  for (const double t : {0.0, 1.0, 12.3}) {
    const FrameState state = evaluate({pitch}, t);
    for (const double along : {0.0, -2.0}) {
      const Vec3 on_axis = pitch.point + along * pitch.axis;
      CHECK((state.position(on_axis) - on_axis).norm() < 1e-14);
      CHECK(state.velocity(on_axis).norm() < 1e-14);
    }
    CHECK((state.R * state.R.transpose() - Mat3::Identity()).norm() < 1e-14);
  }
}

TEST_CASE("signs: a positive angle is right-handed about the axis") {
  const Rotation quarter{.axis = Vec3::UnitZ(), .angle = {.mean = std::numbers::pi / 2}};
  CHECK((evaluate({quarter}, 0).position(Vec3::UnitX()) - Vec3::UnitY()).norm() < 1e-15);
}
