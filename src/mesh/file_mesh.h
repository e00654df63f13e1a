// The mesh as it stands in the file: plain records, complete on one rank, later sent in parts to all.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "mesh/mesh.h"

namespace windhover::mesh {

struct FileCorner {
  PetscInt node = 0, point = 0;
  Vec3 position = Vec3::Zero();
};

/// One face of a cell, seen from that cell: either there is a neighbour, or it lies on a patch.
struct FileSide {
  Index neighbour = -1;     ///< position of the neighbour in the list of cells; -1: none
  int neighbour_side = -1;  ///< which face of the neighbour this is
  int patch = -1;
};

/// Sent between ranks as bytes.
struct FileCell {
  PetscInt file_cell = 0;
  CellType type = CellType::tetrahedron;
  int zone = 0;
  std::array<FileCorner, 8> corners;  ///< VTK's order
  std::array<FileSide, 6> sides;      ///< order of faces_of(type)
};

struct PatchName {
  std::string name;
  int zone = 0;
};

struct FileMesh {
  std::vector<FileCell> cells;
  std::vector<std::string> zones;
  std::vector<PatchName> patches;
};

/// On one rank. UserError: missing, unreadable, cells without zone, holes, faces that fit no rule.
FileMesh read_gmsh(const std::string& file, double scale);

/// UserError for inverted or flat cells.
void check_shapes(const FileMesh& mesh, const std::string& file, double scale);

/// Of types, zones, nodes and positions.
std::uint64_t hash_of(const FileMesh& mesh);

}  // namespace windhover::mesh
