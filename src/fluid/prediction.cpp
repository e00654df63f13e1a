#include "fluid/prediction.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace windhover::fluid {
namespace {

using mesh::Mat3;
using mesh::Vec3;

double kinetic_energy(const double* q) { return 0.5 * (q[1] * q[1] + q[2] * q[2] + q[3] * q[3]) / q[0]; }
Vec3 velocity_of(const double* q) { return Vec3(q[1], q[2], q[3]) / q[0]; }

/// By how much each zone turns in `time` if it goes on as now.
std::vector<Mat3> turns(const Frames& now, double time) {
  std::vector<Mat3> result;
  for (const mesh::FrameState& f : now) {
    const double rate = f.omega.norm();
    result.push_back(rate > 0 ? Eigen::AngleAxisd(rate * time, f.omega / rate).toRotationMatrix() : Mat3::Identity());
  }
  return result;
}

double squared(double x) { return x * x; }
double squared(const Vec3& x) { return x.squaredNorm(); }

/// By how much something goes on in `step` that changed by `last` in the last step and by `earlier` in the one before (step and
/// before in units of the last step; before = 0: unknown): a line, and kShare of what a parabola through three states adds, as
/// long as that is little beside the line. Where it is not, at interfaces and in small cells behind a blade, values swing from
/// step to step, and a parabola would make more of that.
template <class Change>
Change gone_on(double step, double before, const Change& last, const Change& earlier) {
  constexpr double kShare = 0.6, kLittle = 0.5;
  if (before == 0) return step * last;
  const Change bend = 2 / (1 + before) * (last - earlier / before);
  const double part = squared(bend) / (kLittle * kLittle * squared(last) + std::numeric_limits<double>::min());
  return step * last + kShare / (1 + part * part) * 0.5 * step * (step + 1) * bend;
}

}  // namespace

/// Velocity goes on in inertial axes or in those of its zone, in which flow around a blade is nearly steady: where it changed less
/// in the last step. A cell goes on until its pressure has changed by kMost: beyond, what was before says nothing, and a cell near
/// vacuum would stall the linear solver.
void extend(const EulerOperator& euler, const FlowState& state, const Frames& now, double dt, Vec out) {
  constexpr double kMost = 0.2;
  const double gamma = euler.model().gamma;
  const double step = dt / state.last_step, before = state.step_before / state.last_step;
  const std::vector<Mat3> last = turns(now, state.last_step), both = turns(now, state.last_step + state.step_before),
                          next = turns(now, dt);
  const Vec states[3] = {state.q, state.previous, before > 0 ? state.earlier : state.previous};
  const double* values[3] = {};
  double* guess = nullptr;
  for (int k = 0; k < 3; ++k) petsc(VecGetArrayRead(states[k], &values[k]));
  petsc(VecGetArrayWrite(out, &guess));
  for (mesh::Index c = 0; c < euler.mesh().n_owned; ++c) {
    const int zone = euler.mesh().cell_zone[c];
    const double* const q[3] = {values[0] + kVariables * c, values[1] + kVariables * c, values[2] + kVariables * c};
    const double p[3] = {primitive(q[0], gamma).p, primitive(q[1], gamma).p, primitive(q[2], gamma).p};
    const double whole = gone_on(step, before, p[0] - p[1], p[1] - p[2]) / p[0];
    const double share = std::abs(whole) > kMost ? kMost / std::abs(whole) : 1, rise = share * whole;
    const double denser = 1 + rise / gamma;  // dp = c² dρ
    const Vec3 u = velocity_of(q[0]), u1 = velocity_of(q[1]), u2 = velocity_of(q[2]);
    const Vec3 change = u - u1, turned = last[zone] * u1, in_zone = u - turned;
    const Vec3 momentum =
        denser * q[0][0] *
        (in_zone.squaredNorm() < change.squaredNorm()
             ? Vec3(next[zone] * (u + share * gone_on<Vec3>(step, before, in_zone, turned - both[zone] * u2)))
             : Vec3(u + share * gone_on<Vec3>(step, before, change, u1 - u2)));
    double* g = guess + kVariables * c;
    g[0] = denser * q[0][0];
    std::copy_n(momentum.data(), 3, g + 1);
    g[4] = q[0][4] + rise * p[0] / (gamma - 1) + kinetic_energy(g) - kinetic_energy(q[0]);
  }
  petsc(VecRestoreArrayWrite(out, &guess));
  for (int k = 0; k < 3; ++k) petsc(VecRestoreArrayRead(states[k], &values[k]));
}

}  // namespace windhover::fluid
