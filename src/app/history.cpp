#include "app/history.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace windhover::app {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

const std::vector<std::string> kSolverColumns = {"step", "stage", "newton", "residual", "krylov", "seconds"};

}  // namespace

std::vector<std::string> history_columns(const Case& c) {
  std::vector<std::string> columns = {
      "step", "time_s", "x_m", "y_m", "z_m", "vx_m_s", "vy_m_s", "vz_m_s", "roll_deg", "pitch_deg", "yaw_deg",
      "p_deg_s", "q_deg_s", "r_deg_s", "fx_N", "fy_N", "fz_N", "mx_Nm", "my_Nm", "mz_Nm"};
  for (const auto& rotor : c.rotor)
    for (const char* column : {"rpm", "angle_deg", "thrust_N", "torque_Nm", "CT"})
      if (rotor.blade.count > 0) columns.push_back(fmt::format("rotor_{}_{}", rotor.name, column));
  for (const char* column : {"newton", "krylov", "coupling_iterations", "dt_s", "wall_s"}) columns.emplace_back(column);
  return columns;
}

Attitude attitude(const mesh::Mat3& R) {
  return {kDegrees * std::atan2(-R(1, 2), R(1, 1)), kDegrees * std::asin(std::clamp(R(1, 0), -1.0, 1.0)),
          kDegrees * std::atan2(R(2, 0), R(0, 0))};
}

Loads wall_loads(const Case& c, const std::vector<mesh::Patch>& patches, const std::vector<fluid::PatchFlux>& fluxes,
                 const Vec3& point) {
  const Scales scales(c.fluid);
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  for (size_t p = 0; p < patches.size(); ++p) {
    if (std::find(c.body.walls.begin(), c.body.walls.end(), patches[p].name) == c.body.walls.end()) continue;
    force += fluxes[p].force;
    moment += fluxes[p].moment;
  }
  return {scales.force() * force, scales.moment() * (moment - point.cross(force))};
}

History::History(const Case& c, const std::filesystem::path& directory, MPI_Comm comm,
                 std::optional<std::int64_t> last_step)
    : case_(c),
      history_(directory / "history.csv", history_columns(c), comm, last_step),
      solver_(directory / "solver.csv", kSolverColumns, comm, last_step) {}

Loads History::append(fluid::FlowSolver& solver, const mesh::FrameState& f,
                      const std::vector<fluid::PatchFlux>& fluxes, const StepRecord& record) {
  const Scales s(case_.fluid);
  const fluid::FlowState& state = solver.state();
  const Vec3 point = case_.body.moment_point_m / s.length;
  const Vec3 x = s.length * f.position(point), v = s.velocity * f.velocity(point);
  const Vec3 rate = kDegrees / s.time() * (f.R.transpose() * f.omega);
  const Attitude a = attitude(f.R);
  const Loads loads = wall_loads(case_, solver.euler().mesh().patches, fluxes, f.position(point));
  const Vec3 &F = loads.force_N, &M = loads.moment_Nm;
  const double step = static_cast<double>(state.step);
  std::vector<double> row = {
      step, state.time * s.time(), x.x(), x.y(), x.z(), v.x(), v.y(), v.z(), a.roll_deg, a.pitch_deg, a.yaw_deg,
      rate.x(), rate.z(), -rate.y(), F.x(), F.y(), F.z(), M.x(), M.y(), M.z()};
  size_t next = 0;
  for (const auto& rotor : case_.rotor) {
    if (rotor.blade.count == 0) continue;
    const RotorLoads& r = record.rotors.at(next++);
    const double ct = thrust_coefficient(r.thrust_N, r.rpm, case_.fluid.density_kg_m3, rotor.blade.radius_m);
    row.insert(row.end(), {r.rpm, r.angle_deg, r.thrust_N, r.torque_Nm, ct});
  }
  row.insert(row.end(), {double(record.report.newton()), double(record.report.krylov()), double(record.coupling_iterations),
                         state.last_step * s.time(), record.wall_s});
  history_.append(row);
  for (size_t stage = 0; stage < record.report.stages.size(); ++stage) {
    const auto& iterations = record.report.stages[stage].iterations;
    for (size_t i = 0; i < iterations.size(); ++i)
      solver_.append(std::vector<double>{step, double(stage), double(i), iterations[i].residual,
                                         double(iterations[i].krylov), iterations[i].seconds});
  }
  return loads;
}

}  // namespace windhover::app
