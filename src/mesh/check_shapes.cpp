#include <algorithm>

#include "base/errors.h"
#include "mesh/cell_shape.h"
#include "mesh/face_geometry.h"
#include "mesh/file_mesh.h"

namespace windhover::mesh {
namespace {

double longest_edge(const FileCell& cell) {
  double longest = 0;
  for (const ShapeFace& face : faces_of(cell.type))
    for (int i = 0; i < face.n; ++i) {
      const Vec3& a = cell.corners[face.point[i]].position;
      const Vec3& b = cell.corners[face.point[(i + 1) % face.n]].position;
      longest = std::max(longest, (b - a).norm());
    }
  return longest;
}

}  // namespace

void check_shapes(const FileMesh& mesh, const std::string& file, double scale) {
  constexpr double flat = 1e-12;  // of the longest edge cubed
  PetscInt count = 0;
  const FileCell* first = nullptr;
  double first_volume = 0;
  for (const FileCell& cell : mesh.cells) {
    std::array<Vec3, 8> corners;
    for (int i = 0; i < point_count(cell.type); ++i) corners[i] = cell.corners[i].position;
    const double volume = cell_geometry(cell.type, std::span(corners).first(point_count(cell.type))).volume;
    if (volume > flat * std::pow(longest_edge(cell), 3)) continue;
    if (count++ > 0) continue;
    first = &cell;
    first_volume = volume;
  }
  if (count == 0) return;
  const Vec3 p = first->corners[0].position / scale;
  throw UserError("{}: {} cells (of {}) are inverted or flat; the first is cell {} at ({:.6g}, {:.6g}, {:.6g}) with volume {:.3g}",
                  file, count, mesh.cells.size(), first->file_cell, p.x(), p.y(), p.z(),
                  first_volume / (scale * scale * scale));
}

}  // namespace windhover::mesh
