#include "app/flight.h"

#include <algorithm>

#include "app/wind.h"
#include "base/errors.h"

namespace windhover::app {
namespace {

using body::LoadLayout;
using coupling::VectorXd;
using coupling::VehicleState;

mesh::FrameState body_frame(const Case& c, const body::Kinematics& k) {
  const Scales s(c.fluid);
  const Vec3 arm = k.R_WB * c.body.center_of_gravity_m, omega = k.omega_WB_W();
  return {.R = k.R_WB,
          .x = (k.p_WoG_W - arm) / s.length,
          .V = (k.v_WG_W - omega.cross(arm)) / s.velocity,
          .omega = omega * s.time()};
}

std::vector<ZoneTree::Spin> spins(const Case& c, const coupling::Window& window, const VehicleState& vehicle) {
  std::vector<ZoneTree::Spin> spins;
  for (int j = 0; j < window.vehicle().rotors(); ++j)
    spins.push_back({window.rotor_angle(vehicle, j), window.rotor_speed(vehicle, j) * Scales(c.fluid).time()});
  return spins;
}

/// Forces on this much of the reference pressure are round-off.
constexpr double kForceRoundOff = 1e-9;

}  // namespace

Flight::Flight(const Case& c, fluid::FlowSolver& solver, const ZoneTree& zones)
    : case_(c),
      scales_(c.fluid),
      solver_(solver),
      zones_(zones),
      window_(vehicle_model(c)),
      step_(window_, *this, c.coupling, {.length = c.fluid.length_m, .force = kForceRoundOff * scales_.force()}) {
  const mesh::Mesh& mesh = solver.euler().mesh();
  for (const mesh::Patch& patch : mesh.patches)
    is_wall_.push_back(std::find(c.body.walls.begin(), c.body.walls.end(), patch.name) != c.body.walls.end());
  for (const auto& zone : mesh.zones) {
    const auto options = std::find_if(c.zone.begin(), c.zone.end(), [&](const auto& z) { return z.name == zone.name; });
    zone_rotor_.push_back(options == c.zone.end() ? -1 : rotor_of_zone(c, *options));
  }
}

void Flight::open(const std::filesystem::path& directory, std::optional<std::int64_t> last_step) {
  table_.emplace(
      directory / "coupling.csv",
      std::vector<std::string>{"step", "iteration", "load_residual", "pose_residual", "relaxation", "accepted"},
      solver_.euler().mesh().comm, last_step);
}

Flight::Result Flight::advance(double dt) {
  dt_ = dt;
  report_ = {};
  const coupling::StepResult result = step_.advance((solver_.state().time + dt) * scales_.time());
  const double step = static_cast<double>(solver_.state().step + !result.accepted);
  for (size_t i = 0; i < result.iterations.size(); ++i) {
    const coupling::Iteration& it = result.iterations[i];
    table_->append(std::vector<double>{step, double(i + 1), it.load_residual, it.pose_residual, it.relaxation,
                                       double(it.accepted)});
  }
  Result r{report_, static_cast<int>(result.iterations.size()), result.error};
  r.flow.accepted = result.accepted;
  if (!result.accepted) r.flow.reason = result.reason;
  return r;
}

double Flight::next_event() const {
  if (case_.coupling.step_tolerance == 0) return Mover::next_event();
  const double now = vehicle().t * (1 + coupling::kSameTime);
  double event = std::min(window_.next_event(vehicle()), next_wind_change(case_.wind, now));
  if (case_.output.average_from_s > now) event = std::min(event, case_.output.average_from_s);
  return event / scales_.time();
}

mesh::FrameState Flight::body(const VehicleState& vehicle) const {
  return body_frame(case_, window_.kinematics(vehicle));
}

fluid::Frames Flight::frames(const VehicleState& vehicle) const {
  return zones_.frames(body(vehicle), vehicle.t / scales_.time(), spins(case_, window_, vehicle));
}

fluid::FrameFunction Flight::frame_function(const coupling::Trajectory& motion) const {
  return [this, &motion, start = solver_.state().time](double time) {
    constexpr double round_off = 1e-9;  // of a part of the step
    double part = (time - start) / dt_;
    if (std::abs(part - 1) < round_off) part = 1;
    return frames(motion(part < round_off ? 0 : part));
  };
}

void Flight::start_from(std::span<const double> state) {
  step_.restore(state);
  VehicleState vehicle = step_.state().vehicle;
  vehicle.t = 0;
  vehicle.sampled.next_sample = 0;
  step_.start(vehicle);
}

bool Flight::has_walls(int rotor) const {
  const auto& patches = solver_.euler().mesh().patches;
  for (size_t p = 0; p < patches.size(); ++p)
    if (is_wall_[p] && zone_rotor_[patches[p].zone] == rotor) return true;
  return false;
}

coupling::MeanLoads Flight::air(Vec q, const VehicleState& vehicle) {
  const fluid::Frames frames = this->frames(vehicle);
  const auto fluxes = solver_.euler().patch_fluxes(q, frames);
  const body::Kinematics k = window_.kinematics(vehicle);
  const auto& patches = solver_.euler().mesh().patches;
  const auto& rotors = window_.vehicle().vehicle().rotors;
  VectorXd loads = VectorXd::Zero(window_.interface_size());
  coupling::MatrixXd wrenches = coupling::MatrixXd::Zero(6, window_.vehicle().rotors());
  for (size_t p = 0; p < patches.size(); ++p) {
    if (!is_wall_[p]) continue;
    const Vec3 force = scales_.force() * fluxes[p].force, moment = scales_.moment() * fluxes[p].moment;
    const Vec3 torque = moment - k.p_WoG_W.cross(force);
    loads.segment<3>(LoadLayout::force) += force;
    loads.segment<3>(LoadLayout::torque) += torque;
    const int j = zone_rotor_[patches[p].zone];
    if (j < 0) continue;
    wrenches.col(j).head<3>() += force;
    wrenches.col(j).tail<3>() += torque;
    const Vec3 hub = scales_.length * frames[patches[p].zone].position(zones_.spin_point(patches[p].zone));
    loads[LoadLayout::rotor + j] += (k.R_WB * rotors[j].spin_axis_B).dot(moment - hub.cross(force));
  }
  // sums of parallel runs are the same on all ranks by custom only: decisions hang on them
  const MPI_Comm comm = solver_.euler().mesh().comm;
  MPI_Bcast(loads.data(), static_cast<int>(loads.size()), MPI_DOUBLE, 0, comm);
  MPI_Bcast(wrenches.data(), static_cast<int>(wrenches.size()), MPI_DOUBLE, 0, comm);
  coupling::MeanLoads air{loads, {}};
  for (const auto& wrench : wrenches.colwise()) air.rotor_wrench.push_back(wrench);
  return air;
}

VectorXd Flight::loads(const VehicleState& vehicle) { return air(solver_.state().q, vehicle).loads; }

void Flight::begin(const coupling::Trajectory& motion, double) { solver_.begin(frame_function(motion), dt_); }

coupling::FluidSide::Answer Flight::iterate(const coupling::Trajectory& motion, int newton) {
  // one iteration at least where the coupling iterates and the motion is felt: the error of a flow that is left alone would hide
  // the loads' answer
  report_ = solver_.iterate(frame_function(motion), newton, newton > 0);
  Answer answer{.converged = report_.accepted, .failed = report_.failed, .reason = report_.reason, .loads = {}};
  if (!answer.failed) answer.loads = air(solver_.iterate(), motion(1)).loads;
  return answer;
}

fluid::Frames initial_frames(const Case& c, const ZoneTree& zones) {
  if (!is_dynamic(c)) return zones.frames(0);
  const coupling::Window window(vehicle_model(c));
  const VehicleState start = window.start();
  return zones.frames(body_frame(c, window.kinematics(start)), 0, spins(c, window, start));
}

}  // namespace windhover::app
