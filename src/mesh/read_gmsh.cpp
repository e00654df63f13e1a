#include <algorithm>
#include <numeric>
#include <set>

#include "base/errors.h"
#include "mesh/cell_shape.h"
#include "mesh/file_mesh.h"
#include "mesh/pair_faces.h"
#include "mesh/plex_file.h"

namespace windhover::mesh {
namespace {

CellType type_of(DM dm, PetscInt cell, const std::string& file) {
  DMPolytopeType type = DM_POLYTOPE_UNKNOWN;
  petsc(DMPlexGetCellType(dm, cell, &type));
  switch (type) {
    case DM_POLYTOPE_TETRAHEDRON: return CellType::tetrahedron;
    case DM_POLYTOPE_PYRAMID: return CellType::pyramid;
    case DM_POLYTOPE_TRI_PRISM: return CellType::prism;
    case DM_POLYTOPE_HEXAHEDRON: return CellType::hexahedron;
    default: throw UserError("{}: cell {} is no tetrahedron, pyramid, prism or hexahedron", file, cell);
  }
}

/// The nodes of the cells are Plex vertices here; number_corners makes them final.
std::vector<FileCell> read_cells(DM dm, const std::string& file, double scale) {
  PetscInt n_cells = 0;
  petsc(DMPlexGetHeightStratum(dm, 0, nullptr, &n_cells));
  std::vector<FileCell> cells(n_cells);
  for (PetscInt c = 0; c < n_cells; ++c) {
    FileCell& cell = cells[c];
    cell.file_cell = c;
    cell.type = type_of(dm, c, file);
    const PlexCorners corners = corners_of(dm, c);
    // gmsh's prism has its first triangle turned inwards, VTK's outwards
    static constexpr int same[8] = {0, 1, 2, 3, 4, 5, 6, 7}, turned[8] = {0, 2, 1, 3, 5, 4, 6, 7};
    const int* order = cell.type == CellType::prism ? turned : same;
    for (int i = 0; i < corners.size; ++i) {
      cell.corners[i].node = corners.vertex[order[i]];
      cell.corners[i].position = scale * Vec3(corners.position[order[i]]);
    }
  }
  return cells;
}

/// Zones in the order of their physical tags.
std::vector<std::string> read_zones(DM dm, const GmshHeader& header, const std::string& file, double scale,
                                    std::vector<FileCell>& cells) {
  const std::vector<PetscInt> tags = physical_tags(dm, "Cell Sets", 0, static_cast<PetscInt>(cells.size()));
  std::set<PetscInt> used(tags.begin(), tags.end());
  if (used.size() == 1 && used.contains(0)) return {"domain"};
  if (used.contains(0)) {
    const auto first = std::find(tags.begin(), tags.end(), 0) - tags.begin();
    const Vec3 p = cells[first].corners[0].position / scale;
    throw UserError("{}: {} cells belong to no physical volume, the first is cell {} at ({:.6g}, {:.6g}, {:.6g})", file,
                    std::count(tags.begin(), tags.end(), 0), first, p.x(), p.y(), p.z());
  }
  std::vector<std::string> zones;
  for (const PetscInt tag : used) {
    const auto zone = static_cast<int>(zones.size());
    for (std::size_t c = 0; c < cells.size(); ++c)
      if (tags[c] == tag) cells[c].zone = zone;
    zones.push_back(header.name_of(3, tag));
  }
  return zones;
}

}  // namespace

FileMesh read_gmsh(const std::string& file, double scale) {
  const GmshHeader header = read_gmsh_header(file);
  const DmHandle dm = load_plex(file, header);
  FileMesh mesh;
  mesh.cells = read_cells(dm, file, scale);
  mesh.zones = read_zones(dm, header, file, scale, mesh.cells);
  pair_faces(dm, header, file, scale, mesh);
  number_corners(mesh);
  return mesh;
}

}  // namespace windhover::mesh
