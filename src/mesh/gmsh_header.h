// The part of a gmsh file that DMPlex does not hand on: format and physical names.
#pragma once
#include <petscsystypes.h>

#include <map>
#include <string>
#include <utility>

namespace windhover::mesh {

struct GmshHeader {
  bool binary = false;
  std::map<std::pair<int, PetscInt>, std::string> names;  ///< (dimension, physical tag) -> name

  /// The name of a physical group, or its number where the file gives none.
  std::string name_of(int dimension, PetscInt tag) const;
};

/// On one rank. UserError: missing, not a gmsh file, unknown version.
GmshHeader read_gmsh_header(const std::string& file);

}  // namespace windhover::mesh
