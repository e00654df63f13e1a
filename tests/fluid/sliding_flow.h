// Shared by the tests of flow through sliding interfaces.
#pragma once
#include "flow_fixture.h"
#include "mesh/sliding_fixture.h"

namespace windhover::fluid {

/// The whole tree moves with `body`; the inner zone spins about the interface's axis besides.
inline FrameFunction spinning(const mesh::Mesh& mesh, const mesh::SlidingSurface& surface, int inner_zone, double rate,
                              const mesh::Motion& body) {
  return [=, n = mesh.zones.size()](double t) {
    Frames frames(n, mesh::evaluate(body, t));
    const mesh::Motion spin = {mesh::Rotation{surface.axis.normalized(), surface.point, {.rate = rate}}};
    frames[inner_zone] = mesh::compose(frames[inner_zone], mesh::evaluate(spin, t));
    return frames;
  };
}

/// The cylinder of paddle_in_box.geo.
inline mesh::SlidingSurface paddle_surface() {
  return {.shape = mesh::SlidingSurface::Shape::cylinder,
          .point = {0, 0, 0},
          .axis = {0, 0, 1},
          .radius = 0.5,
          .z0 = -0.3,
          .z1 = 0.3};
}
inline mesh::SlidingCase paddle_case(const std::map<std::string, double>& numbers) {
  return mesh::make_sliding(make_mesh("paddle_in_box", numbers), paddle_surface(), "rotor", "box");
}

/// Walls everywhere but on the interface.
inline FlowModel walled(const mesh::Mesh& mesh) {
  FlowModel model;
  for (const auto& patch : mesh.patches)
    if (patch.name != "slide") model.boundary[patch.name] = BoundaryKind::wall;
  return model;
}

/// Σ V q of one variable, over all ranks.
inline double total(const mesh::Mesh& mesh, Vec q, int variable) {
  const double* v = nullptr;
  petsc(VecGetArrayRead(q, &v));
  long double sum = 0;
  for (mesh::Index c = 0; c < mesh.n_owned; ++c) sum += (long double)(mesh.volume[c]) * v[kVariables * c + variable];
  petsc(VecRestoreArrayRead(q, &v));
  double all = static_cast<double>(sum);
  MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
  return all;
}

}  // namespace windhover::fluid
