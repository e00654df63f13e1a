// One rank's part of the distributed mesh: immutable topology and geometry in the zones' own frames.
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "base/petsc.h"
#include "mesh/face_block.h"

namespace windhover::mesh {

using Vec3 = Eigen::Vector3d;
using Index = PetscInt;

enum class CellType : std::uint8_t { tetrahedron = 4, pyramid = 5, prism = 6, hexahedron = 8 };  // value: points

/// A range [begin, end) in an array.
struct Range {
  Index begin = 0, end = 0;
  Index size() const { return end - begin; }
};

/// A region of cells that moves as one rigid body; named by the mesh's physical volume.
struct Zone {
  std::string name;
  Range faces;  ///< its interior face blocks in Mesh::faces
};

/// A named boundary surface of one zone (the mesh's physical surface); blocks is empty on ranks that hold none of it.
struct Patch {
  std::string name;
  int zone = 0;
  std::vector<FaceBlock> blocks;
};

/// Cells are numbered: owned [0, n_owned), then halo cells that share a face with an owned one [n_owned, n_gradient)
/// (gradients are needed there), then halo cells that share a node with any of those [n_gradient, n_cells) (values only).
/// Owned cells are ordered by zone, in a zone from its sliding interfaces on (number_cells.h). Zones, patches: same lists on
/// every rank, in the order of their physical tags (patches of one tag by zone).
/// Zones never share faces or nodes: where their cells touch in the file, the mesh is cut into a patch of each.
/// Periodic surfaces: a node stands for all its periodic images, a point is one image of it; so the neighbours
/// of a cell are found by nodes, its shape by points. Without periodic surfaces points and nodes are the same.
struct Mesh {
  MPI_Comm comm = MPI_COMM_NULL;
  Index n_owned = 0, n_gradient = 0, n_cells = 0;
  PetscInt n_global = 0;      ///< cells on all ranks
  PetscInt first_global = 0;  ///< solver-global number of owned cell 0
  std::vector<PetscInt> global_cell;  ///< [n_gradient] solver-global numbers
  std::vector<PetscInt> file_cell;    ///< [n_owned] number of the cell in the file, from 0 (by type, then place in the
                                      ///< file): independent of ranks
  std::vector<CellType> type;         ///< [n_cells]
  std::vector<int> cell_zone;         ///< [n_cells]
  std::vector<double> volume;         ///< [n_cells]
  std::vector<Vec3> centroid;         ///< [n_cells]
  std::vector<Index> cell_point_start;  ///< [n_cells + 1] into cell_point
  std::vector<Index> cell_point;        ///< points of each cell, in VTK's order for its type
  std::vector<Vec3> point;              ///< positions
  std::vector<Index> point_node;        ///< node of each point
  Index n_nodes = 0;
  std::vector<FaceBlock> faces;         ///< interior faces with at least one owned cell, grouped by zone
  std::vector<Zone> zones;
  std::vector<Patch> patches;
  SfHandle halo;            ///< roots: owned cells, leaves: cells [n_owned, n_cells)
  std::uint64_t hash = 0;   ///< of the cells and coordinates, the same for any number of ranks
};

/// Reads a gmsh file through DMPlex on rank 0, checks it, divides it with PTSCOTCH and adds the halo.
/// Lengths are multiplied by `scale` (metres per unit of the file over the reference length).
/// Collective. UserError, the same on all ranks, with a place in the file's units: file missing or unreadable; hole
/// (boundary face without physical surface); inverted or flat cell; cell without physical volume (unless there is no
/// physical volume at all: then one zone "domain"); faces between zones without a name, or a named surface inside a zone;
/// periodic surfaces that are no translations, badly matched, or less than three cells apart.
/// `sliding`: names of surfaces where zones slide on each other; the division between ranks counts what their faces take.
Mesh read_mesh(const std::string& file, double scale, MPI_Comm comm, const std::set<std::string>& sliding = {});

}  // namespace windhover::mesh
