// Which part of a mesh a sum of rates covers.
#pragma once
#include <vector>

#include "mesh/mesh.h"

namespace windhover::fluid {

/// Own cells within so many layers of face neighbours from those given, ascending.
std::vector<mesh::Index> own_cells_within(const mesh::Mesh& mesh, const std::vector<mesh::Index>& from, int layers);

/// Rates of own cells at the beginning of each zone, in which cells are numbered from sliding interfaces on (mesh.h).
struct Extent {
  std::vector<mesh::Range> cells;    ///< own, of each zone
  std::vector<mesh::Range> faces;    ///< blocks of each zone
  std::vector<int> patch_blocks;     ///< so many of each patch
  std::vector<mesh::Index> touched;  ///< own cells after those in `cells` that have a face of theirs
  std::vector<int> gradients;        ///< cells that need gradients: own in `cells` and those of other ranks beside them

  /// All of the mesh, without the lists.
  static Extent whole(const mesh::Mesh& mesh);
  /// The cells `from` (own, at interfaces) and so many layers of their neighbours by faces.
  static Extent near(const mesh::Mesh& mesh, const std::vector<mesh::Index>& from, int layers);
};

}  // namespace windhover::fluid
