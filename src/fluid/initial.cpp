#include "fluid/initial.h"

#include <cmath>
#include <numbers>

#include "mesh/cell_shape.h"

namespace windhover::fluid {

using mesh::Vec3;

InitialState uniform_state(const State<double>& s) {
  return [s](const Vec3&) { return s; };
}

InitialState riemann_state(const Vec3& direction, double position, const State<double>& left,
                           const State<double>& right) {
  return [=](const Vec3& x) { return direction.dot(x) < position ? left : right; };
}

InitialState vortex_state(const Vec3& center, double strength, double core_radius, const State<double>& far,
                          double gamma) {
  return [=](const Vec3& x) {
    const double dx = (x.x() - center.x()) / core_radius, dy = (x.y() - center.y()) / core_radius;
    const double c2 = gamma * far.p / far.rho;
    const double e = strength / (2 * std::numbers::pi) * std::exp(0.5 * (1 - dx * dx - dy * dy));
    const double temperature = 1 - 0.5 * (gamma - 1) * e * e;  // over the far field's
    const double rho = far.rho * std::pow(temperature, 1 / (gamma - 1));
    return State<double>{rho, far.u - std::sqrt(c2) * e * dy, far.v + std::sqrt(c2) * e * dx, far.w,
                         far.p * std::pow(temperature, gamma / (gamma - 1))};
  };
}

namespace {

/// Calls visit(position, volume) at quadrature points exact for quadratics on each tetrahedron
/// centroid–(face apex, edge) of the cell, in the zone's frame.
template <class Visit>
void for_each_quadrature_point(const mesh::Mesh& mesh, mesh::Index cell, Visit visit) {
  const mesh::Index first = mesh.cell_point_start[cell];
  const auto point = [&](int i) { return mesh.point[mesh.cell_point[first + i]]; };
  for (const auto& face : mesh::faces_of(mesh.type[cell])) {
    Vec3 apex = Vec3::Zero();
    for (int i = 0; i < face.n; ++i) apex += point(face.point[i]) / face.n;
    for (int i = 0; i < face.n; ++i) {
      const Vec3 corner[4] = {mesh.centroid[cell], apex, point(face.point[i]), point(face.point[(i + 1) % face.n])};
      const double volume = (corner[1] - corner[0]).dot((corner[2] - corner[0]).cross(corner[3] - corner[0])) / 6;
      constexpr double a = 0.5854101966249685, b = 0.1381966011250105;  // Keast 1986, degree 2
      const Vec3 sum = b * (corner[0] + corner[1] + corner[2] + corner[3]);
      for (const Vec3& c : corner) visit(Vec3(sum + (a - b) * c), volume / 4);
    }
  }
}

}  // namespace

void set_initial(const EulerOperator& euler, const Frames& frames, const InitialState& initial, Vec q) {
  const mesh::Mesh& mesh = euler.mesh();
  double* values = nullptr;
  petsc(VecGetArrayWrite(q, &values));
  for (mesh::Index c = 0; c < mesh.n_owned; ++c) {
    double mean[kVariables] = {}, volume = 0;
    for_each_quadrature_point(mesh, c, [&](const Vec3& r, double weight) {
      double at[kVariables];
      conserved(initial(frames[mesh.cell_zone[c]].position(r)), euler.model().gamma, at);
      for (int k = 0; k < kVariables; ++k) mean[k] += weight * at[k];
      volume += weight;
    });
    for (int k = 0; k < kVariables; ++k) values[5 * c + k] = mean[k] / volume;
  }
  petsc(VecRestoreArrayWrite(q, &values));
}

void add_velocity(const Vec3& velocity, Vec q) {
  PetscInt n = 0;
  double* values = nullptr;
  petsc(VecGetLocalSize(q, &n));
  petsc(VecGetArray(q, &values));
  for (double* cell = values; cell < values + n; cell += kVariables) {
    Eigen::Map<Vec3> momentum(cell + 1);
    cell[4] += velocity.dot(momentum) + 0.5 * cell[0] * velocity.squaredNorm();
    momentum += cell[0] * velocity;
  }
  petsc(VecRestoreArray(q, &values));
}

}  // namespace windhover::fluid
