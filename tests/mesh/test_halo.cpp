#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "mesh/mesh.h"
#include "mesh_fixture.h"
#include "mesh_sums.h"

using namespace windhover;
using namespace windhover::mesh;

namespace {

/// The file numbers of all cells of the part, halo through mesh.halo.
std::vector<PetscInt> file_cells(const Mesh& mesh) {
  std::vector<PetscInt> numbers(mesh.file_cell);
  numbers.resize(mesh.n_cells, -1);
  petsc(PetscSFBcastBegin(mesh.halo, MPIU_INT, mesh.file_cell.data(), numbers.data(), MPI_REPLACE));
  petsc(PetscSFBcastEnd(mesh.halo, MPIU_INT, mesh.file_cell.data(), numbers.data(), MPI_REPLACE));
  return numbers;
}

std::set<Index> nodes_of(const Mesh& mesh, Index cell) {
  std::set<Index> nodes;
  for (Index k = mesh.cell_point_start[cell]; k < mesh.cell_point_start[cell + 1]; ++k)
    nodes.insert(mesh.point_node[mesh.cell_point[k]]);
  return nodes;
}

/// Neighbours of each cell by file number: {sharing a face, sharing a node}, for the cells [0, end).
using Neighbours = std::map<PetscInt, std::set<PetscInt>>;
Neighbours face_neighbours(const Mesh& mesh, const std::vector<PetscInt>& number) {
  Neighbours neighbours;
  for_each_face(mesh, [&](const FaceBlock& block, int lane, bool boundary) {
    for (int side = 0; side < (boundary ? 0 : 2); ++side)
      if (const int cell = block.cell[side][lane]; cell < mesh.n_owned)
        neighbours[number[cell]].insert(number[block.cell[1 - side][lane]]);
  });
  return neighbours;
}
Neighbours node_neighbours(const Mesh& mesh, const std::vector<PetscInt>& number) {
  std::map<Index, std::set<PetscInt>> cells_of_node;
  for (Index i = 0; i < mesh.n_cells; ++i)
    for (const Index node : nodes_of(mesh, i)) cells_of_node[node].insert(number[i]);
  Neighbours neighbours;
  for (Index i = 0; i < mesh.n_gradient; ++i)
    for (const Index node : nodes_of(mesh, i))
      neighbours[number[i]].insert(cells_of_node[node].begin(), cells_of_node[node].end());
  return neighbours;
}

void check_halo(const std::string& file) {
  const Mesh mesh = read_mesh(file, 1, PETSC_COMM_WORLD), alone = read_mesh(file, 1, PETSC_COMM_SELF);
  const std::vector<PetscInt> number = file_cells(mesh);
  std::vector<Index> by_file(alone.n_cells);
  for (Index i = 0; i < alone.n_cells; ++i) by_file[alone.file_cell[i]] = i;
  for (Index i = 0; i < mesh.n_cells; ++i) {
    REQUIRE(number[i] >= 0);
    REQUIRE(mesh.centroid[i] == alone.centroid[by_file[number[i]]]);
  }
  CHECK(std::set<PetscInt>(number.begin(), number.end()).size() == number.size());

  // every owned cell sees all its face neighbours, every cell with a gradient all its node neighbours, as on one rank
  const Neighbours faces = face_neighbours(alone, alone.file_cell), nodes = node_neighbours(alone, alone.file_cell);
  for (const auto& [cell, neighbours] : face_neighbours(mesh, number)) REQUIRE(neighbours == faces.at(cell));
  for (const auto& [cell, neighbours] : node_neighbours(mesh, number)) REQUIRE(neighbours == nodes.at(cell));

  // no halo cell without reason
  std::set<PetscInt> owned(number.begin(), number.begin() + mesh.n_owned), gradient(number.begin(), number.begin() + mesh.n_gradient);
  const auto meets = [](const std::set<PetscInt>& a, const std::set<PetscInt>& b) {
    return std::any_of(a.begin(), a.end(), [&](PetscInt x) { return b.contains(x); });
  };
  for (Index i = mesh.n_owned; i < mesh.n_gradient; ++i) REQUIRE(meets(faces.at(number[i]), owned));
  for (Index i = mesh.n_gradient; i < mesh.n_cells; ++i) {
    REQUIRE(!meets(faces.at(number[i]), owned));
    REQUIRE(meets(nodes.at(number[i]), gradient));
  }
}

}  // namespace

TEST_CASE("the halo holds what gradients and fluxes need, and nothing else") {
  SECTION("tetrahedra") { check_halo(make_mesh("cube")); }
  SECTION("mixed") { check_halo(make_mesh("mixed")); }
  SECTION("periodic hexahedra") { check_halo(make_mesh("box", {{"nz", 1}, {"px", 1}, {"py", 1}})); }
  SECTION("periodic tetrahedra") { check_halo(make_mesh("periodic_cube")); }
}

TEST_CASE("solver-global numbers agree between owner and halo") {
  const Mesh mesh = read_mesh(make_mesh("cube"), 1, PETSC_COMM_WORLD);
  std::vector<PetscInt> own(mesh.n_owned), seen(mesh.n_cells, -1);
  for (Index i = 0; i < mesh.n_owned; ++i) {
    own[i] = mesh.first_global + i;
    REQUIRE(mesh.global_cell[i] == own[i]);
  }
  petsc(PetscSFBcastBegin(mesh.halo, MPIU_INT, own.data(), seen.data(), MPI_REPLACE));
  petsc(PetscSFBcastEnd(mesh.halo, MPIU_INT, own.data(), seen.data(), MPI_REPLACE));
  for (Index i = mesh.n_owned; i < mesh.n_gradient; ++i) REQUIRE(mesh.global_cell[i] == seen[i]);
}

TEST_CASE("both ranks of a shared face know the same face") {
  const Mesh mesh = read_mesh(make_mesh("mixed"), 1, PETSC_COMM_WORLD);
  const std::vector<PetscInt> number = file_cells(mesh);
  // a sum that is exactly zero when the two copies are bitwise equal: the owner of the lower cell adds, the other subtracts
  std::map<std::pair<PetscInt, PetscInt>, Vec3> shared;
  for_each_face(mesh, [&](const FaceBlock& block, int lane, bool) {
    const int a = block.cell[0][lane], b = block.cell[1][lane];
    REQUIRE((a == b || number[a] < number[b]));
    if (a >= mesh.n_owned || b >= mesh.n_owned) shared[{number[a], number[b]}] = moment_of(block, lane);
  });
  std::vector<double> mine;
  for (const auto& [key, moment] : shared) mine.insert(mine.end(), {moment.x(), moment.y(), moment.z()});
  int n_ranks = 1;
  MPI_Comm_size(mesh.comm, &n_ranks);
  if (n_ranks != 2) return;
  std::vector<double> first = mine;
  auto n = static_cast<int>(mine.size());
  MPI_Bcast(&n, 1, MPI_INT, 0, mesh.comm);
  REQUIRE(n == static_cast<int>(mine.size()));
  MPI_Bcast(first.data(), n, MPI_DOUBLE, 0, mesh.comm);
  CHECK(first == mine);
}
