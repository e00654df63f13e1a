#include "app/zone_tree.h"

#include <algorithm>
#include <set>

#include "app/flow_setup.h"
#include "app/vehicle.h"
#include "app/wind.h"
#include "base/errors.h"
#include "base/options.h"

namespace windhover::app {
namespace {

int find_zone(const mesh::Mesh& mesh, const std::string& name, const std::string& key) {
  std::vector<std::string> names;
  for (size_t z = 0; z < mesh.zones.size(); ++z) {
    if (mesh.zones[z].name == name) return static_cast<int>(z);
    names.push_back(mesh.zones[z].name);
  }
  throw UserError("{}: \"{}\" is not a physical volume of the mesh{}", key, name, suggestion(name, names));
}

int find_patch(const mesh::Mesh& mesh, const std::string& name, int zone, const std::string& key) {
  std::vector<std::string> names;
  for (size_t p = 0; p < mesh.patches.size(); ++p) {
    if (mesh.patches[p].zone != zone) continue;
    if (mesh.patches[p].name == name) return static_cast<int>(p);
    names.push_back(mesh.patches[p].name);
  }
  throw UserError("{}: \"{}\" is not a surface of the zone \"{}\"{}", key, name, mesh.zones[zone].name,
                  suggestion(name, names));
}

mesh::SlidingSurface surface_of(const ZoneOptions& zone, double length) {
  return {.shape = zone.shape == "sphere" ? mesh::SlidingSurface::Shape::sphere : mesh::SlidingSurface::Shape::cylinder,
          .point = zone.point_m / length,
          .axis = zone.axis,
          .radius = zone.radius_m / length,
          .z0 = zone.from_m / length,
          .z1 = zone.to_m / length};
}

}  // namespace

ZonedMesh read_zones(const Case& c, MPI_Comm comm) {
  const double length = c.fluid.length_m, scale = c.mesh.scale_m / length;
  std::set<std::string> sliding;
  for (const ZoneOptions& zone : c.zone) sliding.insert({zone.inner_surface, zone.outer_surface});
  ZonedMesh z{mesh::read_mesh(c.mesh.file, scale, comm, sliding), {}};
  std::vector<mesh::SlidingPair> pairs;
  std::set<int> claimed;
  for (size_t i = 0; i < c.zone.size(); ++i) {
    const ZoneOptions& zone = c.zone[i];
    const std::string key = fmt::format("{}: zone[{}]", c.file.string(), i);
    const int inner = find_patch(z.mesh, zone.inner_surface, find_zone(z.mesh, zone.name, key + ".name"), key + ".inner_surface");
    const int outer = find_patch(z.mesh, zone.outer_surface, find_zone(z.mesh, zone.parent, key + ".parent"), key + ".outer_surface");
    for (const int patch : {inner, outer})
      if (!claimed.insert(patch).second)
        throw UserError("{}: the surface \"{}\" belongs to another zone's interface already", key, z.mesh.patches[patch].name);
    pairs.push_back({surface_of(zone, length), inner, outer});
  }
  try {
    z.interfaces = mesh::make_sliding_interfaces(z.mesh, pairs, scale);
  } catch (const UserError& error) {
    throw UserError("{}: {}: {}", c.file.string(), c.mesh.file, error.what());
  }
  return z;
}

ZoneTree::ZoneTree(const Case& c, const mesh::Mesh& mesh)
    : wind_(c.wind), scales_(c.fluid), body_(scaled_motion(c)), n_zones_(mesh.zones.size()) {
  std::vector<Link> open;
  std::set<int> turning;
  for (size_t i = 0; i < c.zone.size(); ++i) {
    const std::string key = fmt::format("{}: zone[{}]", c.file.string(), i);
    Link link{find_zone(mesh, c.zone[i].name, key + ".name"), find_zone(mesh, c.zone[i].parent, key + ".parent"),
              scaled(zone_rotation(c.zone[i]), Scales(c.fluid)), rotor_of_zone(c, c.zone[i]), 1};
    if (link.rotor >= 0 && link.rotation.axis.dot(c.body.vehicle.rotor[link.rotor].spin_axis) < 0) link.sense = -1;
    if (!turning.insert(link.zone).second) throw UserError("{}.name: \"{}\" has an entry already", key, c.zone[i].name);
    open.push_back(std::move(link));
  }
  while (!open.empty()) {
    const auto ready = std::find_if(open.begin(), open.end(), [&](const Link& l) { return !turning.contains(l.parent); });
    if (ready == open.end()) throw UserError("{}: zone: \"{}\" turns inside itself", c.file.string(), mesh.zones[open.front().zone].name);
    turning.erase(ready->zone);
    links_.push_back(std::move(*ready));
    open.erase(ready);
  }
}

fluid::Frames ZoneTree::frames(const mesh::FrameState& body, double time, const std::vector<Spin>& spins) const {
  mesh::FrameState outermost = body;
  outermost.V -= wind_change(wind_, time * scales_.time()) / scales_.velocity;
  fluid::Frames frames(n_zones_, outermost);
  for (const Link& link : links_) {
    mesh::Rotation rotation = link.rotation;
    if (link.rotor >= 0) {
      const Spin& spin = spins.at(link.rotor);
      rotation.angle = {.mean = link.sense * spin.angle, .rate = link.sense * spin.speed};
    }
    const double now = link.rotor >= 0 ? 0 : time;  // a spin is that of this moment
    frames[link.zone] = mesh::compose(frames[link.parent], mesh::evaluate({rotation}, now));
  }
  return frames;
}

Vec3 ZoneTree::spin_point(int zone) const {
  return std::find_if(links_.begin(), links_.end(), [&](const Link& l) { return l.zone == zone; })->rotation.point;
}

}  // namespace windhover::app
