#include "mesher/airframe_model.h"

#include <gmsh.h>

#include <map>

#include "base/errors.h"
#include "geometry/airframe.h"
#include "geometry/rotor.h"
#include "mesher/solids.h"

namespace windhover::mesher {
namespace {

namespace occ = gmsh::model::occ;
using geometry::GeometryOptions;
using geometry::RotorOptions;

std::string text(const Vec3& p) { return fmt::format("({:.4g}, {:.4g}, {:.4g}) m", p.x(), p.y(), p.z()); }

Vec3 center_of(const std::pair<int, int>& volume) {
  Vec3 c;
  occ::getCenterOfMass(volume.first, volume.second, c.x(), c.y(), c.z());
  return c;
}

/// Solids of the STEP file, in metres.
gmsh::vectorpair import_step(const std::string& file) {
  gmsh::option::setString("Geometry.OCCTargetUnit", "M");
  gmsh::vectorpair shapes, solids;
  occ::importShapes(file, shapes, true, "step");
  for (const auto& shape : shapes)
    if (shape.first == 3) solids.push_back(shape);
  if (solids.empty()) throw UserError("airframe: {}: has no solid", file);
  return solids;
}

int add_solid(const geometry::AirframeOptions& airframe) {
  gmsh::vectorpair solids, whole;
  if (!airframe.step.empty()) solids = import_step(airframe.step);
  for (const auto& part : all_parts(airframe)) solids.emplace_back(3, add_part(part));
  if (solids.size() == 1) return solids.front().second;
  std::vector<gmsh::vectorpair> map;
  occ::fuse({solids.front()}, {solids.begin() + 1, solids.end()}, whole, map);
  if (whole.size() > 1)
    throw UserError("airframe: falls into {} pieces that do not touch, the centres of the first two at {} and {}",
                    whole.size(), text(center_of(whole[0])), text(center_of(whole[1])));
  return whole.front().second;
}

/// The zone may be inside the airframe altogether.
void check_overlap(int airframe, const RotorOptions& rotor) {
  const int zone = add_cylinder(rotor, rotor.zone.radius_m, rotor.zone.from_m, rotor.zone.to_m);
  gmsh::vectorpair common;
  std::vector<gmsh::vectorpair> map;
  occ::intersect({{3, airframe}}, {{3, zone}}, common, map, -1, false, true);
  for (const auto& piece : common)
    if (piece.first == 3)
      throw UserError("rotor \"{}\": its zone overlaps the airframe at {}", rotor.name, text(center_of(piece)));
  occ::remove(common, true);
}

struct Nodes {
  std::vector<Vec3> points;
  std::vector<double> sizes;  ///< the mean length of the edges there
};

/// Meshes the surfaces alone, by their curvature.
Nodes mesh_alone(const geometry::AirframeOptions& airframe, double refine) {
  double x0, y0, z0, x1, y1, z1;
  gmsh::model::getBoundingBox(-1, -1, x0, y0, z0, x1, y1, z1);
  const double extent = Vec3(x1 - x0, y1 - y0, z1 - z0).maxCoeff();
  const double largest = airframe.size_m > 0 ? airframe.size_m : 0.03 * extent;
  const double smallest = airframe.min_size_m > 0 ? airframe.min_size_m : largest / 8;
  gmsh::option::setNumber("Mesh.MeshSizeMax", largest / refine);
  gmsh::option::setNumber("Mesh.MeshSizeMin", smallest / refine);
  gmsh::option::setNumber("Mesh.MeshSizeFromCurvature", airframe.cells_per_turn * refine);
  gmsh::model::mesh::generate(2);
  std::vector<size_t> tags, edges;
  std::vector<double> coordinates, unused;
  gmsh::model::mesh::getNodes(tags, coordinates, unused);
  constexpr int triangle = 2;
  gmsh::model::mesh::getElementEdgeNodes(triangle, edges);
  std::map<size_t, size_t> index;
  Nodes nodes;
  for (size_t i = 0; i < tags.size(); ++i) {
    index[tags[i]] = i;
    nodes.points.emplace_back(coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]);
  }
  std::vector<double> sum(tags.size(), 0), count(tags.size(), 0);
  for (size_t e = 0; e < edges.size(); e += 2) {
    const size_t a = index[edges[e]], b = index[edges[e + 1]];
    for (const size_t node : {a, b}) sum[node] += (nodes.points[a] - nodes.points[b]).norm(), ++count[node];
  }
  for (size_t i = 0; i < tags.size(); ++i) nodes.sizes.push_back(count[i] > 0 ? sum[i] / count[i] : largest / refine);
  gmsh::model::mesh::clear();
  gmsh::option::setNumber("Mesh.MeshSizeFromCurvature", 0);
  gmsh::option::setNumber("Mesh.MeshSizeMin", 0);
  gmsh::option::setNumber("Mesh.MeshSizeMax", 1e22);
  return nodes;
}

void check_clearance(const std::vector<Vec3>& points, const GeometryOptions& geometry) {
  for (const Vec3& p : points) {
    for (const RotorOptions& r : geometry.rotor)
      if (const double clearance = 0.01 * r.blade.radius_m;
          depth(r, r.zone.radius_m, r.zone.from_m, r.zone.to_m, p) > -clearance)
        throw UserError("rotor \"{}\": its zone comes nearer to the airframe than {:.3g} m at {}", r.name, clearance,
                        text(p));
    if ((p - geometry.farfield.center_m).norm() >= geometry.farfield.radius_m)
      throw UserError("airframe: leaves the ball mesh.farfield of radius {} m at {}", geometry.farfield.radius_m,
                      text(p));
  }
}

}  // namespace

AirframeModel add_airframe(const GeometryOptions& geometry) {
  if (!geometry.airframe.is_given()) return {};
  const int solid = add_solid(geometry.airframe);
  for (const RotorOptions& rotor : geometry.rotor) check_overlap(solid, rotor);
  AirframeModel model{keep_surfaces(solid), {}};
  const Nodes nodes = mesh_alone(geometry.airframe, geometry.refine);
  check_clearance(nodes.points, geometry);
  model.sizes = {nodes.points, nodes.sizes, geometry.airframe.growth};
  return model;
}

}  // namespace windhover::mesher
