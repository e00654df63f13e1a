#include "fluid/prediction.h"

#include <algorithm>
#include <array>

#include "fluid/eight.h"

namespace windhover::fluid {
namespace {

using mesh::Mat3;
typedef std::array<Pack, 3> Vector;  // of eight cells

/// By how much each zone turns in `time` if it goes on as now.
std::vector<Mat3> turns(const Frames& now, double time) {
  std::vector<Mat3> result;
  for (const mesh::FrameState& f : now) {
    const double rate = f.omega.norm();
    result.push_back(rate > 0 ? Eigen::AngleAxisd(rate * time, f.omega / rate).toRotationMatrix() : Mat3::Identity());
  }
  return result;
}

Vector operator*(const Mat3& m, const Vector& v) {
  Vector r;
  for (int i = 0; i < 3; ++i) r[i] = m(i, 0) * v[0] + m(i, 1) * v[1] + m(i, 2) * v[2];
  return r;
}

template <size_t n>
std::array<Pack, n> operator-(std::array<Pack, n> a, const std::array<Pack, n>& b) {
  for (size_t i = 0; i < n; ++i) a[i] -= b[i];
  return a;
}

template <size_t n>
Pack squared(const std::array<Pack, n>& v) {
  Pack sum(0.0);
  for (const Pack& x : v) sum += x * x;
  return sum;
}

/// How what changed in the last two steps goes on: a line, and kShare of what a parabola through three states adds, as long as
/// that is little beside the line. Where it is not, at interfaces and in small cells behind a blade, values swing from step to
/// step, and a parabola would make more of that.
class Course {
 public:
  /// Times of the next step, the last one and the one before that (0: unknown).
  Course(double next, double last, double before)
      : line_(next / last),
        before_(before > 0 ? last / before : 0),
        bend_(before > 0 ? 2 * last / (last + before) : 0),
        parabola_(0.5 * line_ * (line_ + 1)) {}

  /// From what changed in the last step and in the one before.
  template <size_t n>
  std::array<Pack, n> operator()(const std::array<Pack, n>& last, const std::array<Pack, n>& before) const {
    constexpr double kShare = 0.6, kLittle = 0.5, kNothing = 1e-100;
    std::array<Pack, n> bend, result;
    for (size_t i = 0; i < n; ++i) bend[i] = bend_ * (last[i] - before_ * before[i]);
    const Pack little = kLittle * kLittle * squared(last) + kNothing, bent = squared(bend), whole = little * little;
    const Pack share = kShare * parabola_ * whole / (whole + bent * bent);
    for (size_t i = 0; i < n; ++i) result[i] = line_ * last[i] + share * bend[i];
    return result;
  }

 private:
  double line_, before_, bend_, parabola_;
};

Vector velocity(const State<Pack>& s) { return {s.u, s.v, s.w}; }

/// Conserved variables of the first `count` of eight cells.
void store(const State<Pack>& s, double gamma, int count, double* to) {
  const Pack energy = s.p * (1 / (gamma - 1)) + 0.5 * s.rho * speed_squared(s);
  const Pack columns[8] = {s.rho, s.rho * s.u, s.rho * s.v, s.rho * s.w, energy, 0.0, 0.0, 0.0};
  Pack rows[8];
  transpose(columns, rows);
  for (int j = 0; j < count; ++j)
    for (int k = 0; k < kVariables; ++k) to[kVariables * j + k] = rows[j][k];
}

}  // namespace

/// Velocity goes on in inertial axes or in those of its zone, in which flow around a blade is nearly steady: where it changed less
/// in the last step. A cell goes on until its pressure has changed by kMost: beyond, what was before says nothing, and a cell near
/// vacuum would stall the linear solver.
void extend(const EulerOperator& euler, const FlowState& state, const Frames& now, double dt, Vec out) {
  constexpr double kMost = 0.2;
  const double gamma = euler.model().gamma;
  const Course go_on(dt, state.last_step, state.step_before);
  const std::vector<Mat3> last = turns(now, state.last_step), both = turns(now, state.last_step + state.step_before),
                          next = turns(now, dt);
  const Vec states[3] = {state.q, state.previous, state.step_before > 0 ? state.earlier : state.previous};
  const double* values[3] = {};
  double* guess = nullptr;
  for (int k = 0; k < 3; ++k) petsc(VecGetArrayRead(states[k], &values[k]));
  petsc(VecGetArrayWrite(out, &guess));
  for (size_t z = 0; z < euler.zone_cells().size(); ++z) {
    const mesh::Range& zone = euler.zone_cells()[z];
    for (mesh::Index c = zone.begin; c < zone.end; c += 8) {
      State<Pack> at[3];
      for (int k = 0; k < 3; ++k) {
        Pack columns[8];
        load_columns(Eight<kVariables, double>(values[k] + kVariables * c, euler.mesh().n_owned - c), columns);
        at[k] = primitive(columns, gamma);
      }
      const auto& [s, s1, s2] = at;
      const Vector u = velocity(s), u1 = velocity(s1), u2 = velocity(s2);
      const Vector change = u - u1, turned = last[z] * u1, in_zone = u - turned;
      const Pack line = go_on(std::array{s.p - s1.p}, std::array{s1.p - s2.p})[0] * reciprocal(s.p);
      const Pack size = select(line < Pack(0.0), -line, line), share = select(Pack(kMost) < size, kMost / size, Pack(1.0));
      const Pack rise = share * line;
      const Vector straight = go_on(change, u1 - u2), around = go_on(in_zone, turned - both[z] * u2);
      Vector inertial, zonal;
      for (int i = 0; i < 3; ++i) inertial[i] = u[i] + share * straight[i], zonal[i] = u[i] + share * around[i];
      zonal = next[z] * zonal;
      const auto steadier = squared(in_zone) < squared(change);
      const auto chosen = [&](int i) { return select(steadier, zonal[i], inertial[i]); };
      const Pack rho = s.rho * (1.0 + rise * (1 / gamma));  // dp = c² dρ
      store({rho, chosen(0), chosen(1), chosen(2), s.p * (1.0 + rise)}, gamma, std::min<int>(8, zone.end - c),
            guess + kVariables * c);
    }
  }
  petsc(VecRestoreArrayWrite(out, &guess));
  for (int k = 0; k < 3; ++k) petsc(VecRestoreArrayRead(states[k], &values[k]));
}

}  // namespace windhover::fluid
