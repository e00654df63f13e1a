// Zones with a sliding interface between them, as tests use them.
#pragma once
#include "mesh/sliding/sliding_interface.h"
#include "mesh_fixture.h"
#include "mesh_sums.h"

namespace windhover::mesh {

/// A mesh of two zones that meet in patches named "slide", and the interface between them.
struct SlidingCase {
  Mesh mesh;
  std::vector<SlidingInterface> interfaces;
  const SlidingInterface& interface() const { return interfaces.at(0); }
};

inline int find_patch(const Mesh& mesh, const std::string& name, const std::string& zone) {
  for (std::size_t p = 0; p < mesh.patches.size(); ++p)
    if (mesh.patches[p].name == name && mesh.zones[mesh.patches[p].zone].name == zone) return static_cast<int>(p);
  throw std::runtime_error("no surface " + name + " of zone " + zone);
}

inline SlidingCase make_sliding(const std::string& file, const SlidingSurface& surface, const std::string& inner,
                                const std::string& outer, MPI_Comm comm = PETSC_COMM_WORLD, double scale = 1) {
  SlidingCase c;
  c.mesh = read_mesh(file, scale, comm);
  const SlidingPair pair{surface, find_patch(c.mesh, "slide", inner), find_patch(c.mesh, "slide", outer)};
  c.interfaces = make_sliding_interfaces(c.mesh, std::span(&pair, 1), scale);
  return c;
}

inline const Vec3 tilted_axis = Vec3(1, 2, 2) / 3;

/// The cylinder of cylinder_in_ball.geo; with layers its axis is along z.
inline SlidingSurface rotor_surface(const Vec3& axis = tilted_axis) {
  return {.shape = SlidingSurface::Shape::cylinder,
          .point = {0.2, -0.1, 0.15},
          .axis = axis,
          .radius = 0.6,
          .z0 = 0,
          .z1 = 0.5};
}
inline SlidingCase cylinder_case(const std::map<std::string, double>& numbers = {}, MPI_Comm comm = PETSC_COMM_WORLD) {
  const bool upright = numbers.contains("layers");
  return make_sliding(make_mesh("cylinder_in_ball", numbers, "", comm),
                      rotor_surface(upright ? Vec3::UnitZ() : tilted_axis), "rotor", "ball", comm);
}

/// The sphere of sphere_in_box.geo about a slanted axis.
inline SlidingSurface ball_surface() {
  return {.shape = SlidingSurface::Shape::sphere, .point = {0.1, 0.2, -0.1}, .axis = {3, -1, 2}, .radius = 0.5};
}
inline SlidingCase sphere_case(const std::map<std::string, double>& numbers = {}, MPI_Comm comm = PETSC_COMM_WORLD) {
  return make_sliding(make_mesh("sphere_in_box", numbers, "", comm), ball_surface(), "ball", "box", comm);
}

}  // namespace windhover::mesh
