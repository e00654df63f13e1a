#include <span>
#include <sstream>
#include <unordered_map>

#include "base/errors.h"
#include "base/memory.h"
#include "mesh/build_faces.h"
#include "mesh/cell_shape.h"
#include "mesh/distribute.h"
#include "mesh/face_geometry.h"
#include "mesh/file_mesh.h"
#include "mesh/number_cells.h"

namespace windhover::mesh {
namespace {

void broadcast(std::string& text, MPI_Comm comm) {
  auto size = static_cast<int>(text.size());
  MPI_Bcast(&size, 1, MPI_INT, 0, comm);
  text.resize(size);
  MPI_Bcast(text.data(), size, MPI_CHAR, 0, comm);
}

/// Rank 0 reads and checks; its error is thrown on all ranks.
FileMesh read_and_check(const std::string& file, double scale, MPI_Comm comm) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  FileMesh whole;
  std::string error;
  if (rank == 0) try {
      whole = read_gmsh(file, scale);
      check_shapes(whole, file, scale);
    } catch (const std::exception& e) {
      error = e.what();
    }
  broadcast(error, comm);
  if (!error.empty()) throw UserError(error);
  return whole;
}

/// Everything every rank must know of the whole: zones, patches, hash and number of cells.
void share_lists(const FileMesh& whole, Mesh& mesh) {
  std::ostringstream out;
  for (const std::string& zone : whole.zones) out << -1 << ' ' << zone << '\n';
  for (const PatchName& patch : whole.patches) out << patch.zone << ' ' << patch.name << '\n';
  std::string text = out.str();
  broadcast(text, mesh.comm);
  std::istringstream in(text);
  int zone = 0;
  for (std::string name; in >> zone && std::getline(in.ignore(1), name);) {
    if (zone < 0)
      mesh.zones.push_back({.name = name, .faces = {}});
    else
      mesh.patches.push_back({.name = name, .zone = zone, .blocks = {}});
  }
  mesh.hash = hash_of(whole);
  MPI_Bcast(&mesh.hash, 1, MPI_UINT64_T, 0, mesh.comm);
  mesh.n_global = static_cast<PetscInt>(whole.cells.size());
  MPI_Bcast(&mesh.n_global, 1, MPIU_INT, 0, mesh.comm);
}

/// Local numbers in the order of first appearance.
class Compaction {
 public:
  std::pair<Index, bool> number(PetscInt original) {
    const auto [found, is_new] = local_.try_emplace(original, static_cast<Index>(local_.size()));
    return {found->second, is_new};
  }
  Index size() const { return static_cast<Index>(local_.size()); }

 private:
  std::unordered_map<PetscInt, Index> local_;
};

void fill_cells(const MeshPart& part, const Numbering& numbering, Mesh& mesh) {
  Compaction nodes, points;
  const std::size_t n_cells = numbering.cell.size();
  mesh.type.reserve(n_cells);
  mesh.cell_zone.reserve(n_cells);
  mesh.volume.reserve(n_cells);
  mesh.centroid.reserve(n_cells);
  mesh.cell_point_start.reserve(n_cells + 1);
  mesh.cell_point_start.push_back(0);
  for (const Index position : numbering.cell) {
    const FileCell& cell = part.cells[position];
    std::array<Vec3, 8> corners;
    for (int i = 0; i < point_count(cell.type); ++i) {
      const FileCorner& corner = cell.corners[i];
      corners[i] = corner.position;
      const Index node = nodes.number(corner.node).first;
      const auto [point, is_new] = points.number(corner.point);
      mesh.cell_point.push_back(point);
      if (!is_new) continue;
      mesh.point.push_back(corner.position);
      mesh.point_node.push_back(node);
    }
    const CellGeometry g = cell_geometry(cell.type, std::span(corners).first(point_count(cell.type)));
    mesh.type.push_back(cell.type);
    mesh.cell_zone.push_back(cell.zone);
    mesh.volume.push_back(g.volume);
    mesh.centroid.push_back(g.centroid);
    mesh.cell_point_start.push_back(static_cast<Index>(mesh.cell_point.size()));
  }
  mesh.n_nodes = nodes.size();
  mesh.cell_point.shrink_to_fit();
  mesh.point.shrink_to_fit();
  mesh.point_node.shrink_to_fit();
}

Mesh build_mesh(const std::string& file, double scale, MPI_Comm comm, const std::set<std::string>& sliding) {
  Mesh mesh;
  mesh.comm = comm;
  FileMesh whole = read_and_check(file, scale, comm);
  share_lists(whole, mesh);
  const MeshPart part = distribute(whole, sliding, comm);
  whole = {};  // gives its memory back
  std::vector<bool> slides;
  for (const Patch& patch : mesh.patches) slides.push_back(sliding.contains(patch.name));
  Numbering numbering = number_cells(part, slides, comm);
  mesh.n_owned = part.n_owned;
  mesh.n_gradient = part.n_gradient;
  mesh.n_cells = static_cast<Index>(part.cells.size());
  mesh.first_global = numbering.first_global;
  mesh.global_cell.assign(numbering.global.begin(), numbering.global.begin() + mesh.n_gradient);
  for (Index i = 0; i < mesh.n_owned; ++i) mesh.file_cell.push_back(part.cells[numbering.cell[i]].file_cell);
  fill_cells(part, numbering, mesh);
  build_faces(part, numbering, mesh);
  mesh.halo = std::move(numbering.halo);
  return mesh;
}

}  // namespace

Mesh read_mesh(const std::string& file, double scale, MPI_Comm comm, const std::set<std::string>& sliding) {
  Mesh mesh = build_mesh(file, scale, comm, sliding);
  release_free_memory();  // reading takes several times what is kept
  return mesh;
}

}  // namespace windhover::mesh
