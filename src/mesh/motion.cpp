#include "mesh/motion.h"

namespace windhover::mesh {

FrameState compose(const FrameState& outer, const FrameState& inner) {
  const Vec3 arm = outer.R * inner.x;
  return {.R = outer.R * inner.R,
          .x = outer.x + arm,
          .V = outer.V + outer.omega.cross(arm) + outer.R * inner.V,
          .omega = outer.omega + outer.R * inner.omega};
}

namespace {

FrameState evaluate(const Translation& m, double t) {
  return {.x = m.distance.value(t) * m.direction, .V = m.distance.derivative(t) * m.direction};
}

FrameState evaluate(const Rotation& m, double t) {
  const Mat3 R = Eigen::AngleAxisd(m.angle.value(t), m.axis).toRotationMatrix();
  const Vec3 omega = m.angle.derivative(t) * m.axis;
  const Vec3 from_point = -(R * m.point);  // the frame's origin, seen from the fixed point
  return {.R = R, .x = m.point + from_point, .V = omega.cross(from_point), .omega = omega};
}

}  // namespace

FrameState evaluate(const Motion& motion, double t) {
  FrameState state;
  for (const auto& element : motion)
    state = compose(state, std::visit([t](const auto& m) { return evaluate(m, t); }, element));
  return state;
}

}  // namespace windhover::mesh
