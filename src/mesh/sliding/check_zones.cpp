#include "mesh/sliding/check_zones.h"

#include "base/collective.h"

namespace windhover::mesh {
namespace {

/// Whether each zone turns with that of an interface: itself, or carried by it.
std::vector<bool> carried_by(const Mesh& mesh, const std::vector<std::array<InterfaceSide, 2>>& sides, int zone) {
  std::vector<bool> carried(mesh.zones.size(), false);
  carried[zone] = true;
  for (bool more = true; more;) {
    more = false;
    for (const auto& [inner, outer] : sides) {
      if (carried[inner.zone] || !carried[outer.zone]) continue;
      carried[inner.zone] = more = true;
    }
  }
  return carried;
}

}  // namespace

void check_zones(const Mesh& mesh, std::span<const RevolutionSurface> surfaces,
                 const std::vector<std::array<InterfaceSide, 2>>& sides, double scale) {
  collectively(mesh.comm, [&] {
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
      const RevolutionSurface& surface = surfaces[i];
      const std::vector<bool> inside = carried_by(mesh, sides, sides[i][0].zone);
      double worst = surface.tolerance();
      int zone = -1;
      Vec3 place = Vec3::Zero();
      for (Index c = 0; c < mesh.n_owned; ++c)
        for (Index k = mesh.cell_point_start[c]; k < mesh.cell_point_start[c + 1]; ++k) {
          const Vec3& r = mesh.point[mesh.cell_point[k]];
          const Vec3 local = surface.to_local(r);
          if (surface.contains(local) == inside[mesh.cell_zone[c]]) continue;
          const double distance = surface.place(local).distance;
          if (distance <= worst) continue;
          worst = distance, zone = mesh.cell_zone[c], place = r;
        }
      if (zone < 0) continue;
      place /= scale;
      throw UserError("sliding interface of zone '{}': {} zone '{}' reaches {:.3g} {} it, at ({:.6g}, {:.6g}, {:.6g})",
                      mesh.zones[sides[i][0].zone].name, inside[zone] ? "a blade or cell of" : "overlap:", mesh.zones[zone].name,
                      worst / scale, inside[zone] ? "through" : "into", place.x(), place.y(), place.z());
    }
  });
}

}  // namespace windhover::mesh
