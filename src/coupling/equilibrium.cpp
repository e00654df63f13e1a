#include "coupling/equilibrium.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <numbers>

#include "base/errors.h"
#include "base/options.h"

namespace windhover::coupling {
namespace {

using body::Freedom;
using body::kFreedomNames;
using body::Mat3;
using body::Vec3;
using body::Vec6;

constexpr int kMotions = 6;

/// Places of the names among all that could be named. UserError: none of them, or twice.
std::vector<int> find_all(const std::vector<std::string>& names, const std::vector<std::string>& valid,
                          const std::string& key) {
  std::vector<int> found;
  for (const std::string& name : names) {
    const auto at = std::find(valid.begin(), valid.end(), name);
    if (at == valid.end()) throw UserError("{}: no \"{}\"{}", key, name, suggestion(name, valid));
    found.push_back(static_cast<int>(at - valid.begin()));
    if (std::count(found.begin(), found.end(), found.back()) > 1) throw UserError("{}: \"{}\" twice", key, name);
  }
  return found;
}

std::vector<std::string> motion_names() { return {kFreedomNames.begin(), kFreedomNames.end()}; }

}  // namespace

Equilibrium::Equilibrium(const Window& window, const TrimOptions& options, double length)
    : window_(window), tolerance_(options.tolerance), max_evaluations_(options.max_evaluations) {
  start_ = {Vec6::Zero(), VectorXd::Zero(window.vehicle().rotors())};
  start_ = hold(window.start());
  require_steady();
  choose_balance(options);
  choose_unknowns(options, length);
  set_scales(options);
  if (unknowns_.size() != balance_.size())
    throw UserError("trim.unknowns: {} ({}) for {} in trim.balance ({}): as many are needed", unknowns_.size(),
                    quoted_list(unknown_names_), balance_.size(), quoted_list(balance_names_));
}

void Equilibrium::require_steady() const {
  const auto& freedoms = window_.vehicle().vehicle().mount.freedoms();
  for (int k = 0; k < kMotions; ++k) {
    const Freedom& f = freedoms[k];
    if (f.motion && (f.motion->amplitude != 0 || (k >= 3 && f.motion->rate != 0)))
      throw UserError("body.mount.{}: is prescribed to {}, and a trim holds the vehicle still", kFreedomNames[k],
                      f.motion->amplitude != 0 ? "oscillate" : "turn");
    if (!f.motion && f.initial_rate != 0 && (k >= 3 || f.sprung()))
      throw UserError("body.{}: is not zero for {}, and a trim holds the vehicle still",
                      k < 3 ? "velocity_m_s" : "rotation_rate_rad_s", kFreedomNames[k]);
  }
}

void Equilibrium::choose_balance(const TrimOptions& options) {
  const auto& freedoms = window_.vehicle().vehicle().mount.freedoms();
  if (options.balance.empty()) {
    for (int k = 0; k < kMotions; ++k)
      if (freedoms[k].is_state()) balance_.push_back(k);
    if (balance_.empty()) throw UserError("trim.balance: body.mount leaves the body no motion: nothing needs balance");
  } else {
    balance_ = find_all(options.balance, motion_names(), "trim.balance");
  }
  for (const int k : balance_) {
    if (!freedoms[k].is_state())
      throw UserError("trim.balance: \"{0}\" is held by body.mount.{0}, which takes any force", kFreedomNames[k]);
    balance_names_.emplace_back(kFreedomNames[k]);
  }
}

void Equilibrium::choose_unknowns(const TrimOptions& options, double length) {
  const auto& freedoms = window_.vehicle().vehicle().mount.freedoms();
  const auto& rotors = window_.vehicle().vehicle().rotors;
  std::vector<std::string> names = motion_names();
  for (const auto& rotor : rotors) names.push_back(rotor.name);
  if (options.unknowns.empty()) {
    for (int k = 0; k < kMotions; ++k)
      if (freedoms[k].is_state() && (freedoms[k].sprung() || k == 3 || k == 5)) unknowns_.push_back(k);
    for (size_t j = 0; j < rotors.size(); ++j) unknowns_.push_back(static_cast<int>(kMotions + j));
  } else {
    unknowns_ = find_all(options.unknowns, names, "trim.unknowns");
  }
  unknown_scale_.resize(static_cast<Eigen::Index>(unknowns_.size()));
  for (size_t i = 0; i < unknowns_.size(); ++i) {
    const int k = unknowns_[i];
    unknown_names_.push_back(names[k]);
    if (k >= kMotions && start_.rotor_speed[k - kMotions] <= 0)
      throw UserError("body.rotor[{}].speed_rad_s: is {}, and the trim starts from it: must be > 0", k - kMotions,
                      start_.rotor_speed[k - kMotions]);
    if (k < kMotions && !freedoms[k].is_state())
      throw UserError("trim.unknowns: \"{0}\" is held by body.mount.{0}", names[k]);
    if (k < 3 && !freedoms[k].sprung())
      throw UserError("trim.unknowns: \"{0}\" is free and on no spring: where the body is along it changes no force",
                      names[k]);
    unknown_scale_[i] = k < 3          ? length
                        : k < kMotions ? options.max_turn_deg * std::numbers::pi / 180
                                       : options.max_speed_change * start_.rotor_speed[k - kMotions];
  }
}

void Equilibrium::set_scales(const TrimOptions& options) {
  const body::Vehicle& vehicle = window_.vehicle().vehicle();
  const double weight = vehicle.mass * vehicle.gravity_W.norm();
  const double force = options.force_scale_N > 0 ? options.force_scale_N : weight;
  if (!(force > 0))
    throw UserError("trim.force_scale_N: is needed, since body.gravity_m_s2 is zero: there is no weight");
  const double largest =
      Eigen::SelfAdjointEigenSolver<Mat3>(vehicle.inertia_BG_B, Eigen::EigenvaluesOnly).eigenvalues()[2];
  force_scale_.resize(static_cast<Eigen::Index>(balance_.size()));
  for (size_t i = 0; i < balance_.size(); ++i)
    force_scale_[i] = balance_[i] < 3 ? force : force * std::sqrt(largest / vehicle.mass);
}

BalanceOptions Equilibrium::solver_options() const {
  BalanceOptions options{.tolerance = tolerance_, .max_evaluations = max_evaluations_};
  for (const int k : unknowns_) options.positive.push_back(k >= kMotions);
  return options;
}

Hold Equilibrium::hold(const VehicleState& state) const {
  const body::VehicleOde& vehicle = window_.vehicle();
  const auto& freedoms = vehicle.vehicle().mount.freedoms();
  const std::span<const double> y(state.y);
  Hold hold = start_;
  const Vec6 coordinates =
      vehicle.vehicle().mount.coordinates(state.t, y.first(vehicle.vehicle().mount.position_size()));
  const bool is_start = unknowns_.empty();
  const auto sought = [&](int k) {
    return is_start || std::find(unknowns_.begin(), unknowns_.end(), k) != unknowns_.end();
  };
  for (int k = 0; k < kMotions; ++k)
    if (freedoms[k].is_state() && sought(k)) hold.coordinates[k] = coordinates[k];
  for (int j = 0; j < vehicle.rotors(); ++j)
    if (sought(kMotions + j)) hold.rotor_speed[j] = window_.rotor_speed(state, j);
  return hold;
}

Hold Equilibrium::hold(const VectorXd& u) const {
  Hold hold = start_;
  for (size_t i = 0; i < unknowns_.size(); ++i) {
    const int k = unknowns_[i];
    (k < kMotions ? hold.coordinates[k] : hold.rotor_speed[k - kMotions]) = u[i] * unknown_scale_[i];
  }
  return hold;
}

VectorXd Equilibrium::scaled_unknowns(const Hold& hold) const {
  VectorXd u(unknown_scale_.size());
  for (size_t i = 0; i < unknowns_.size(); ++i) {
    const int k = unknowns_[i];
    u[i] = (k < kMotions ? hold.coordinates[k] : hold.rotor_speed[k - kMotions]) / unknown_scale_[i];
  }
  return u;
}

VehicleState Equilibrium::state(double t, const Hold& hold, const Vec6& rates, const VectorXd& rotor_angle,
                                double moved_s) const {
  const body::VehicleOde& vehicle = window_.vehicle();
  const body::Mount& mount = vehicle.vehicle().mount;
  Vec6 coordinates = hold.coordinates, velocities = rates;
  for (int k = 0; k < 3; ++k) {
    const Freedom& f = mount.freedoms()[k];
    if (!f.is_state()) continue;
    coordinates[k] += f.initial_rate * moved_s;
    velocities[k] += f.initial_rate;
  }
  VehicleState s = window_.start();
  s.t = t;
  const std::span<double> y(s.y);
  mount.place(coordinates, velocities, y.first(mount.position_size()),
              y.subspan(mount.position_size(), mount.speed_size()));
  for (int j = 0; j < vehicle.rotors(); ++j) {
    y[vehicle.rotor_speed_offset() + j] = hold.rotor_speed[j];
    y[vehicle.rotor_angle_offset() + j] = rotor_angle[j];
  }
  return s;
}

VehicleState Equilibrium::state(double t, const Hold& hold) const {
  return state(t, hold, Vec6::Zero(), VectorXd::Zero(hold.rotor_speed.size()));
}

int Equilibrium::speed_index(int freedom) const {
  const auto& freedoms = window_.vehicle().vehicle().mount.freedoms();
  return static_cast<int>(
      std::count_if(freedoms.begin(), freedoms.begin() + freedom, [](const Freedom& f) { return f.is_state(); }));
}

VectorXd Equilibrium::unbalanced(const Hold& hold, const VectorXd& loads) const {
  const body::VehicleOde& vehicle = window_.vehicle();
  const VehicleState s = state(0, hold);
  const body::Speeds all = vehicle.unbalanced(s.t, s.y, {loads.data(), static_cast<size_t>(loads.size())});
  VectorXd left(force_scale_.size());
  for (size_t i = 0; i < balance_.size(); ++i) left[i] = all[speed_index(balance_[i])];
  return left;
}

MeanLoads Equilibrium::modelled(const Hold& there, const Hold& hold, const MeanLoads& mean) const {
  const Mat3 turn = window_.kinematics(state(0, there)).R_WB * window_.kinematics(state(0, hold)).R_WB.transpose();
  MeanLoads model = mean;
  for (Eigen::Index j = 0; j < hold.rotor_speed.size(); ++j) {
    const Vec6& wrench = mean.rotor_wrench[j];
    const double ratio = hold.rotor_speed[j] == 0 ? 1 : there.rotor_speed[j] / hold.rotor_speed[j];
    const double square = ratio * ratio;
    model.loads.segment<3>(body::LoadLayout::force) += square * (turn * wrench.head<3>()) - wrench.head<3>();
    model.loads.segment<3>(body::LoadLayout::torque) += square * (turn * wrench.tail<3>()) - wrench.tail<3>();
  }
  return model;
}

MatrixXd Equilibrium::model_jacobian(const Hold& hold, const MeanLoads& mean) const {
  constexpr double step = 1e-4;
  const VectorXd u = scaled_unknowns(hold);
  MatrixXd J(force_scale_.size(), u.size());
  for (Eigen::Index i = 0; i < u.size(); ++i) {
    const auto at = [&](double du) {
      const Hold there = this->hold(u + du * VectorXd::Unit(u.size(), i));
      return residual(there, modelled(there, hold, mean).loads);
    };
    J.col(i) = (at(step) - at(-step)) / (2 * step);
    if (J.col(i).norm() < 1e-9) J.col(i).setZero();  // round-off of what changes nothing
  }
  return J;
}

}  // namespace windhover::coupling
