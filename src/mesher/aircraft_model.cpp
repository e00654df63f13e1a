#include "mesher/aircraft_model.h"

#include <gmsh.h>

#include <numeric>

#include "geometry/blade.h"
#include "geometry/size_field.h"
#include "mesher/airframe_model.h"
#include "mesher/solids.h"

namespace windhover::mesher {
namespace {

using geometry::GeometryOptions;
using geometry::RotorOptions;

constexpr double kTurn = 2 * M_PI;

/// turn: so that the seams and meshes of two copies are not in the same place.
std::vector<int> add_zone_surface(const RotorOptions& rotor, double turn) {
  const int volume = add_cylinder(rotor, rotor.zone.radius_m, rotor.zone.from_m, rotor.zone.to_m);
  const Vec3 &c = rotor.center_m, &a = rotor.axis;
  gmsh::model::occ::rotate({{3, volume}}, c.x(), c.y(), c.z(), a.x(), a.y(), a.z(), turn);
  return keep_surfaces(volume);
}

/// The surfaces of one rotor, before volumes are made of them.
struct RotorSurfaces {
  std::vector<int> inner, outer, hub, blades;
};

RotorSurfaces add_surfaces(const RotorOptions& rotor) {
  RotorSurfaces s{add_zone_surface(rotor, 0), add_zone_surface(rotor, 0.3 * kTurn), {}, {}};
  const auto& hub = rotor.hub;
  if (hub.radius_m > 0) s.hub = keep_surfaces(add_cylinder(rotor, hub.radius_m, hub.from_m, hub.to_m, hub.rounding_m));
  return s;
}

/// nodes_before: in the blades so far; no other surface has nodes yet.
int add_blade(const geometry::TriangleSurface& blade, size_t nodes_before) {
  const int surface = gmsh::model::addDiscreteEntity(2);
  std::vector<size_t> nodes(blade.points.size()), corners;
  std::iota(nodes.begin(), nodes.end(), nodes_before + 1);
  std::vector<double> coordinates;
  for (const Vec3& p : blade.points) coordinates.insert(coordinates.end(), p.begin(), p.end());
  gmsh::model::mesh::addNodes(2, surface, nodes, coordinates);
  for (const auto& triangle : blade.triangles)
    for (const int corner : triangle) corners.push_back(nodes[corner]);
  constexpr int triangle_type = 2;
  gmsh::model::mesh::addElementsByType(surface, triangle_type, {}, corners);
  return surface;
}

/// After all surfaces of OpenCASCADE.
void add_all_blades(const GeometryOptions& geometry, std::vector<RotorSurfaces>& surfaces) {
  size_t nodes = 0;
  for (size_t i = 0; i < surfaces.size(); ++i) {
    const geometry::Blades blades(geometry.rotor[i], geometry.refine);
    for (int k = 0; k < geometry.rotor[i].blade.count; ++k) {
      const auto blade = blades.surface(k);
      surfaces[i].blades.push_back(add_blade(blade, nodes));
      nodes += blade.points.size();
    }
  }
}

std::vector<int> joined(std::vector<int> a, const std::vector<int>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

void add_volume(const RotorOptions& rotor, const RotorSurfaces& s) {
  std::vector<int> loops = {gmsh::model::geo::addSurfaceLoop(s.inner)};
  if (!s.hub.empty()) loops.push_back(gmsh::model::geo::addSurfaceLoop(s.hub));
  for (const int blade : s.blades) loops.push_back(gmsh::model::geo::addSurfaceLoop({blade}));
  const int volume = gmsh::model::geo::addVolume(loops);
  gmsh::model::geo::synchronize();
  name(3, {volume}, rotor.name);
  name(2, s.blades, rotor.name + "_blades");
  if (!s.hub.empty()) name(2, s.hub, rotor.name + "_hub");
  name(2, joined(s.inner, s.outer), rotor.name + "_slide");
}

void add_volumes(const GeometryOptions& geometry, const std::vector<int>& ball, const std::vector<int>& airframe,
                 const std::vector<RotorSurfaces>& rotors) {
  std::vector<int> loops = {gmsh::model::geo::addSurfaceLoop(ball)};
  if (!airframe.empty()) loops.push_back(gmsh::model::geo::addSurfaceLoop(airframe));
  for (const RotorSurfaces& s : rotors) loops.push_back(gmsh::model::geo::addSurfaceLoop(s.outer));
  const int outer = gmsh::model::geo::addVolume(loops);
  gmsh::model::geo::synchronize();
  for (size_t i = 0; i < rotors.size(); ++i) add_volume(geometry.rotor[i], rotors[i]);
  name(3, {outer}, "outer");
  name(2, ball, "farfield");
  if (!airframe.empty()) name(2, airframe, "airframe");
}

}  // namespace

void mesh_aircraft(const GeometryOptions& geometry) {
  gmsh::model::add("aircraft");
  const AirframeModel airframe = add_airframe(geometry);
  std::vector<RotorSurfaces> rotors;
  for (const RotorOptions& rotor : geometry.rotor) rotors.push_back(add_surfaces(rotor));
  const auto& far = geometry.farfield;
  const std::vector<int> ball =
      keep_surfaces(gmsh::model::occ::addSphere(far.center_m.x(), far.center_m.y(), far.center_m.z(), far.radius_m));
  add_all_blades(geometry, rotors);
  add_volumes(geometry, ball, airframe.surfaces, rotors);
  const geometry::SizeField size(geometry, airframe.sizes);
  gmsh::model::mesh::setSizeCallback([&](int, int, double x, double y, double z) { return size({x, y, z}); });
  gmsh::option::setNumber("Mesh.MeshSizeExtendFromBoundary", 0);  // blades' short edges are not for the volume
  constexpr int hxt = 10;  // leaves far fewer flat cells at the blades than the others
  gmsh::option::setNumber("Mesh.Algorithm3D", hxt);
  gmsh::option::setNumber("Mesh.MaxNumThreads3D", 1);  // the same mesh every time
  gmsh::model::mesh::generate(3);
  gmsh::model::mesh::optimize("");  // HXT leaves cells of 0.2 degrees in some fine meshes
  gmsh::model::mesh::removeSizeCallback();
}

}  // namespace windhover::mesher
