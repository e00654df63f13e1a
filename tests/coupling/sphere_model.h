// A sphere on a spring in still gas whose flow is not a mesh but two states of linear acoustics, advanced by
// Crank–Nicolson like the flow solver: the coupling's own errors, alone. Radius, sound speed and displaced mass are 1.
#pragma once
#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <unsupported/Eigen/MatrixFunctions>

#include "coupling/coupled_step.h"

namespace windhover::coupling {

/// F = -(U - w - 2z), z' = w, w' = U - 2w - 2z: the force -s U (1 + s)/(2 + 2s + s^2) of numerics.md.
class AcousticSphere : public FluidSide {
 public:
  explicit AcousticSphere(const Window& window, double newton_error = 0)
      : window_(window), newton_error_(newton_error) {}

  VectorXd loads(const VehicleState& vehicle) override { return load(velocity(vehicle), now_); }
  void begin(const Trajectory& motion, double dt) override {
    start_velocity_ = velocity(motion(0));
    dt_ = dt;
    next_ = now_;
    error_ = 1;
    ++begun;
  }
  Answer iterate(const Trajectory& motion, int newton) override {
    ++iterated;
    const double velocity = this->velocity(motion(1));
    Eigen::Matrix2d A;
    A << 0, 1, -2, -2;
    const Eigen::Matrix2d I = Eigen::Matrix2d::Identity();
    const Eigen::Vector2d b(0, 0.5 * (start_velocity_ + velocity));
    const Eigen::Vector2d solved = (I - 0.5 * dt_ * A).inverse() * ((I + 0.5 * dt_ * A) * now_ + dt_ * b);
    error_ *= newton == 0 ? 0 : std::pow(newton_error_, newton);  // of a Newton that is not finished
    next_ = solved + error_ * (now_ - solved);
    return {.converged = error_ < 1e-9, .failed = false, .reason = {}, .loads = load(velocity, next_)};
  }
  void accept() override { now_ = next_; }
  int order() const override { return 2; }

  int begun = 0, iterated = 0;
  double side_force = 0;  ///< on the locked y axis: changes sign and grows from step to step

 private:
  double velocity(const VehicleState& vehicle) const { return window_.kinematics(vehicle).v_WG_W.x(); }
  VectorXd load(double velocity, const Eigen::Vector2d& air) const {
    VectorXd loads = VectorXd::Zero(window_.interface_size());
    loads[0] = -(velocity - air[1] - 2 * air[0]);
    loads[1] = side_force * begun * (begun % 2 ? 1 : -1);
    return loads;
  }

  const Window& window_;
  double newton_error_, error_ = 0;
  Eigen::Vector2d now_ = Eigen::Vector2d::Zero(), next_ = now_;
  double start_velocity_ = 0, dt_ = 0;
};

struct SphereCase {
  double mass = 1, stiffness = 1, start = 0.01;

  VehicleModel model() const {
    VehicleModel m;
    body::VehicleOptions& o = m.vehicle;
    o.mass_kg = mass;
    o.inertia_kg_m2 = body::Vec3::Ones() * mass;
    o.gravity_m_s2.setZero();
    o.position_m.x() = start;
    o.mount.x.kind = "spring";
    o.mount.x.stiffness = stiffness;
    for (body::FreedomOptions* f : std::initializer_list<body::FreedomOptions*>{
             &o.mount.y, &o.mount.z, &o.mount.rotation_x, &o.mount.rotation_y, &o.mount.rotation_z})
      f->kind = "locked";
    m.integrator = {.relative_tolerance = 1e-11, .absolute_tolerance = 1e-14};
    return m;
  }

  /// Displacement, velocity and the two states of the air.
  Eigen::Vector4d exact(double t) const {
    Eigen::Matrix4d A;
    A << 0, 1, 0, 0, -stiffness / mass, -1 / mass, 2 / mass, 1 / mass, 0, 0, 0, 1, 0, 1, -2, -2;
    return (A * t).exp() * Eigen::Vector4d(start, 0, 0, 0);
  }
};

/// One run of the model, step by step.
struct SphereRun {
  SphereRun(const SphereCase& sphere, const CouplingOptions& options, double newton_error = 0)
      : window(sphere.model()), air(window, newton_error), step(window, air, options, {.length = 1, .force = 1e-9}) {
    step.start();
  }
  StepResult advance(double dt) { return step.advance(step.state().vehicle.t + dt); }
  double displacement() const { return window.kinematics(step.state().vehicle).p_WoG_W.x(); }

  Window window;
  AcousticSphere air;
  CoupledStep step;
};

}  // namespace windhover::coupling
