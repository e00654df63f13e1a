#include "mesher/solids.h"

#include <gmsh.h>

#include <Eigen/Geometry>
#include <set>

namespace windhover::mesher {
namespace {

namespace occ = gmsh::model::occ;
using geometry::PartOptions;

/// Rounds the curves of a volume that are circles, or all of them.
int round_edges(int volume, double radius, bool circles_only) {
  occ::synchronize();
  gmsh::vectorpair surfaces, curves, rounded;
  gmsh::model::getBoundary({{3, volume}}, surfaces, false, false);
  gmsh::model::getBoundary(surfaces, curves, false, false);
  std::set<int> edges;  // each belongs to two surfaces
  for (const auto& [dimension, tag] : curves) {
    std::string type;
    gmsh::model::getType(dimension, tag, type);
    if (!circles_only || type == "Circle") edges.insert(tag);
  }
  occ::fillet({volume}, {edges.begin(), edges.end()}, {radius}, rounded);
  return rounded.front().second;
}

int add_box(const PartOptions& part) {
  const Vec3 low = part.center_m - part.size_m / 2;
  const int volume = occ::addBox(low.x(), low.y(), low.z(), part.size_m.x(), part.size_m.y(), part.size_m.z());
  return part.rounding_m > 0 ? round_edges(volume, part.rounding_m, false) : volume;
}

int add_ellipsoid(const PartOptions& part) {
  const Vec3 &c = part.center_m, &r = part.radii_m;
  const int volume = occ::addSphere(c.x(), c.y(), c.z(), 1);
  occ::dilate({{3, volume}}, c.x(), c.y(), c.z(), r.x(), r.y(), r.z());
  return volume;
}

/// Half balls whose discs are those of the cylinder between them: nothing is tangent, which booleans like better.
int add_capsule(const PartOptions& part) {
  const Vec3 along = part.to_m - part.from_m;
  const double r = part.radius_m, length = along.norm();
  const int middle = occ::addCylinder(0, 0, 0, 0, 0, length, r);
  const int below = occ::addSphere(0, 0, 0, r, -1, -M_PI / 2, 0),
            above = occ::addSphere(0, 0, length, r, -1, 0, M_PI / 2);
  gmsh::vectorpair whole;
  std::vector<gmsh::vectorpair> map;
  occ::fuse({{3, middle}}, {{3, below}, {3, above}}, whole, map);
  const Eigen::AngleAxisd turn(Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), along));
  occ::rotate(whole, 0, 0, 0, turn.axis().x(), turn.axis().y(), turn.axis().z(), turn.angle());
  occ::translate(whole, part.from_m.x(), part.from_m.y(), part.from_m.z());
  return whole.front().second;
}

}  // namespace

int add_cylinder(const Vec3& from, const Vec3& to, double radius, double rounding) {
  const Vec3 along = to - from;
  const int volume = occ::addCylinder(from.x(), from.y(), from.z(), along.x(), along.y(), along.z(), radius);
  return rounding > 0 ? round_edges(volume, rounding, true) : volume;
}

int add_cylinder(const geometry::RotorOptions& rotor, double radius, double from, double to, double rounding) {
  const Vec3 axis = rotor.axis.normalized();
  return add_cylinder(rotor.center_m + from * axis, rotor.center_m + to * axis, radius, rounding);
}

int add_part(const PartOptions& part) {
  if (part.kind == "box") return add_box(part);
  if (part.kind == "ellipsoid") return add_ellipsoid(part);
  if (part.kind == "capsule") return add_capsule(part);
  return add_cylinder(part.from_m, part.to_m, part.radius_m, part.rounding_m);
}

std::vector<int> keep_surfaces(int volume) {
  occ::synchronize();
  gmsh::vectorpair boundary;
  gmsh::model::getBoundary({{3, volume}}, boundary, true, false);
  occ::remove({{3, volume}});
  occ::synchronize();
  std::vector<int> surfaces;
  for (const auto& [dimension, tag] : boundary) surfaces.push_back(tag);
  return surfaces;
}

void name(int dimension, const std::vector<int>& tags, const std::string& text) {
  const int group = gmsh::model::addPhysicalGroup(dimension, tags);
  gmsh::model::setPhysicalName(dimension, group, text);
}

}  // namespace windhover::mesher
