// Shared by the solver's tests: meshes, models, motions.
#pragma once
#include <random>

#include "fluid/flow_solver.h"
#include "fluid/initial.h"
#include "mesh_fixture.h"

namespace windhover::fluid {

/// All patches far field, or the named ones otherwise.
inline FlowModel model_for(const mesh::Mesh& mesh, const std::map<std::string, BoundaryKind>& special = {}) {
  FlowModel model;
  for (const auto& patch : mesh.patches) {
    const auto found = special.find(patch.name);
    model.boundary[patch.name] = found == special.end() ? BoundaryKind::farfield : found->second;
  }
  return model;
}

inline FlowModel closed_box(const mesh::Mesh& mesh) {
  FlowModel model;
  for (const auto& patch : mesh.patches) model.boundary[patch.name] = BoundaryKind::wall;
  return model;
}

/// Tumbling about tilted axes and translating: every kind of motion at once. Points of a unit box move at about `speed`.
inline mesh::Motion tumbling(double speed = 1) {
  return {mesh::Translation{mesh::Vec3(1, 2, -0.5).normalized(), {.rate = 0.3 * speed, .amplitude = 0.2, .omega = 3 * speed}},
          mesh::Rotation{mesh::Vec3(1, 1, 0.3).normalized(), mesh::Vec3(0.2, 0, 0.1), {.rate = 0.9 * speed}},
          mesh::Rotation{mesh::Vec3(0, 0.2, 1).normalized(), mesh::Vec3(0.5, 0.5, 0.5), {.amplitude = 0.4, .omega = 2 * speed}}};
}

inline FrameFunction frames_of(const mesh::Mesh& mesh, const mesh::Motion& motion) {
  return [n = mesh.zones.size(), motion](double t) { return Frames(n, mesh::evaluate(motion, t)); };
}

/// Reproducible noise by cell of the file, the same for any number of ranks: uniform in [−1, 1].
inline double noise(PetscInt cell, int k) {
  std::mt19937 random(static_cast<unsigned>(5 * cell + k + 1));
  return std::uniform_real_distribution<double>(-1, 1)(random);
}

inline void add_noise(const EulerOperator& euler, double amplitude, Vec q) {
  double* v = nullptr;
  petsc(VecGetArray(q, &v));
  for (mesh::Index c = 0; c < euler.mesh().n_owned; ++c)
    for (int k = 0; k < kVariables; ++k) v[5 * c + k] += amplitude * noise(euler.mesh().file_cell[c], k);
  petsc(VecRestoreArray(q, &v));
}

inline double norm(Vec v, NormType type = NORM_2) {
  double n = 0;
  petsc(VecNorm(v, type, &n));
  return n;
}

inline double distance(Vec a, Vec b, NormType type = NORM_2) {
  VecHandle d;
  petsc(VecDuplicate(a, d.out()));
  petsc(VecWAXPY(d, -1, a, b));
  return norm(d, type);
}

/// How far the exact derivative along noise is from central differences, relative.
inline double derivative_error(EulerOperator& euler, Vec q, const Frames& frames) {
  VecHandle dq = euler.make_vector(), exact = euler.make_vector(), plus = euler.make_vector(),
            minus = euler.make_vector(), moved = euler.make_vector();
  add_noise(euler, 1.0, dq);
  euler.linearize(q, frames);
  euler.derivative(dq, exact);
  const double h = 1e-6;
  petsc(VecWAXPY(moved, h, dq, q));
  euler.residual(moved, frames, plus);
  petsc(VecWAXPY(moved, -h, dq, q));
  euler.residual(moved, frames, minus);
  petsc(VecAXPY(plus, -1, minus));
  petsc(VecScale(plus, 0.5 / h));
  return distance(plus, exact) / norm(exact);
}

/// What single precision changes in the derivative along random changes, relative to it; never nothing.
inline double rounding_of_derivative(EulerOperator& euler, Vec q, const Frames& frames) {
  VecHandle dq = euler.make_vector(), exact = euler.make_vector(), single = euler.make_vector();
  add_noise(euler, 1.0, dq);
  euler.linearize(q, frames);
  euler.derivative(dq, exact);
  euler.derivative(dq, single, {}, {}, true);
  const double change = distance(exact, single) / norm(exact);
  REQUIRE(change > 0);
  return change;
}

}  // namespace windhover::fluid
