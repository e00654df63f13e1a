// A quadcopter held in a wind whose air is a formula: rotors whose thrust falls with the flow through their discs and
// rises with the flow across them, and an airframe with drag. Its balance can be found independently.
#pragma once
#include <catch2/catch.hpp>
#include <numbers>

#include "coupling/equilibrium.h"

namespace windhover::coupling {

using body::Mat3;
using body::Vec3;

struct QuadcopterModel {
  static constexpr double kThrust = 2.1e-5, kTorque = 3.6e-7, kRadius = 0.133, kDensity = 1.247;
  Vec3 wind_W = Vec3(-5, 0, 0);
  double drag_area = 0.02;

  static VehicleModel vehicle() {
    VehicleModel m;
    m.vehicle.mass_kg = 1.72;
    m.vehicle.inertia_kg_m2 = Vec3(0.0158, 0.0313, 0.0173);
    const auto add = [&](const char* name, double x, double z, double spin) {
      m.vehicle.rotor.push_back({.name = name,
                                 .inertia_kg_m2 = 6.7e-5,
                                 .spin_axis = Vec3(0, spin, 0),
                                 .speed_rad_s = 400,
                                 .motor = {.kind = "servo"}});
      m.rotors.push_back({.name = name,
                          .p_GR_B = Vec3(x, 0.0624, z),
                          .spin = spin,
                          .thrust_N_s2 = kThrust,
                          .torque_Nm_s2 = kTorque,
                          .min_speed_rad_s = 150,
                          .max_speed_rad_s = 800});
    };
    add("front_right", 0.14665, 0.18515, 1);
    add("front_left", 0.14665, -0.18515, -1);
    add("rear_right", -0.14665, 0.18515, -1);
    add("rear_left", -0.14665, -0.18515, 1);
    m.controller.kind = "cascade";
    m.controller.cascade.position_gain_1_s = Vec3(0, 1.5, 0);
    return m;
  }

  MeanLoads loads(const Window& window, const VehicleState& state) const {
    const body::Kinematics k = window.kinematics(state);
    const Vec3 wind_B = k.R_WB.transpose() * (wind_W - k.v_WG_W);
    const auto models = vehicle().rotors;
    MeanLoads mean{VectorXd::Zero(body::LoadLayout::size(4)), {}};
    Vec3 force = 0.5 * kDensity * drag_area * wind_W.norm() * wind_W, moment = Vec3::Zero();
    for (int j = 0; j < 4; ++j) {
      const double speed = window.rotor_speed(state, j), tip = speed * kRadius;
      const double front = models[j].p_GR_B.x() > 0 ? 1.1 : 1;  // front rotors are in cleaner air
      const double through = wind_B.y() / tip, across = std::hypot(wind_B.x(), wind_B.z()) / tip;
      const double thrust = kThrust * speed * speed * front * (1 + 2 * through + 1.5 * across * across);
      const Vec3 torque_B = models[j].p_GR_B.cross(thrust * Vec3::UnitY()) -
                            models[j].spin * kTorque * speed * speed * Vec3::UnitY() -
                            0.02 * thrust * kRadius * models[j].spin * Vec3::UnitX();
      const Vec3 f = k.R_WB * Vec3(-0.01 * thrust, thrust, 0), m = k.R_WB * torque_B;
      force += f;
      moment += m;
      mean.rotor_wrench.push_back((body::Vec6() << f, m).finished());
    }
    mean.loads.head<3>() = force;
    mean.loads.segment<3>(3) = moment;
    return mean;
  }
};

/// The model's trim, evaluation by evaluation; `noise`: of the scaled residual, as of means that are not settled.
class ModelTrim : public BalanceProblem {
 public:
  ModelTrim(const Window& window, const Equilibrium& equilibrium, const QuadcopterModel& model, double noise = 0)
      : window_(window), equilibrium_(equilibrium), model_(model), noise_(noise) {}

  std::optional<VectorXd> evaluate(const VectorXd& u) override {
    hold_ = equilibrium_.hold(u);
    mean_ = model_.loads(window_, equilibrium_.state(0, hold_));
    ++evaluations;
    VectorXd residual = equilibrium_.residual(hold_, mean_.loads);
    for (Eigen::Index i = 0; i < residual.size(); ++i) residual[i] += noise_ * std::sin(37.0 * (i + 1) * evaluations);
    if (evaluations == stop_at) return {};
    return residual;
  }
  MatrixXd model_jacobian() override { return equilibrium_.model_jacobian(hold_, mean_); }

  const Hold& hold() const { return hold_; }
  const MeanLoads& mean() const { return mean_; }
  int evaluations = 0, stop_at = -1;

 private:
  const Window& window_;
  const Equilibrium& equilibrium_;
  QuadcopterModel model_;
  double noise_;
  Hold hold_;
  MeanLoads mean_;
};

}  // namespace windhover::coupling
