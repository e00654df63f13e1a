#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>

#include "base/errors.h"
#include "mesh/mesh.h"
#include "mesh_fixture.h"

using namespace windhover;
using namespace windhover::mesh;
using Catch::Matchers::Contains;

namespace {

/// A file with the given text in the build folder. Collective.
std::string write_file(const std::string& name, const std::string& text) {
  const std::string folder = WINDHOVER_BINARY_DIR "/meshes", file = folder + "/" + name + ".msh";
  int rank = 0, n_ranks = 1;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  MPI_Comm_size(PETSC_COMM_WORLD, &n_ranks);
  const std::string own = fmt::format("{}.{}", file, n_ranks);  // runs on other numbers of ranks do not meet
  if (rank == 0) {
    std::filesystem::create_directories(folder);
    std::ofstream(own) << text;
  }
  MPI_Barrier(PETSC_COMM_WORLD);
  return own;
}

/// Two tetrahedra on the two sides of a triangle; elements as lines of msh 2.2.
std::string two_tetrahedra(const std::vector<std::string>& elements, const std::string& last_node = "0.3 0.3 -1") {
  std::ostringstream out;
  out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 1 \"skin\"\n3 2 \"air\"\n$EndPhysicalNames\n"
      << "$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0.3 0.3 1\n5 " << last_node << "\n$EndNodes\n"
      << "$Elements\n" << elements.size() << "\n";
  for (std::size_t i = 0; i < elements.size(); ++i) out << i + 1 << ' ' << elements[i] << '\n';
  out << "$EndElements\n";
  return out.str();
}

const std::vector<std::string> skin{"2 2 1 1 1 2 4", "2 2 1 1 2 3 4", "2 2 1 1 3 1 4",
                                    "2 2 1 1 1 2 5", "2 2 1 1 2 3 5", "2 2 1 1 3 1 5"};
const std::vector<std::string> cells{"4 2 2 1 1 2 3 4", "4 2 2 1 1 3 2 5"};

std::vector<std::string> operator+(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// The message of the UserError, which must be the same on all ranks.
std::string error_of(const std::string& file, double scale = 1) {
  std::string message = "no error";
  try {
    read_mesh(file, scale, PETSC_COMM_WORLD);
  } catch (const UserError& e) {
    message = e.what();
  }
  std::string first = message;
  auto size = static_cast<int>(first.size());
  MPI_Bcast(&size, 1, MPI_INT, 0, PETSC_COMM_WORLD);
  first.resize(size);
  MPI_Bcast(first.data(), size, MPI_CHAR, 0, PETSC_COMM_WORLD);
  CHECK(first == message);
  return message;
}

std::string text_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

}  // namespace

TEST_CASE("the smallest mesh that is right") {
  const Mesh mesh = read_mesh(write_file("right", two_tetrahedra(skin + cells)), 1, PETSC_COMM_WORLD);
  CHECK(mesh.n_global == 2);
  CHECK(mesh.patches.at(0).name == "skin");
}

TEST_CASE("files that are no mesh") {
  CHECK_THAT(error_of("nowhere.msh"), Contains("nowhere.msh: no such mesh file"));
  CHECK_THAT(error_of(write_file("text", "hello\n")), Contains("not a gmsh mesh"));
  CHECK_THAT(error_of(write_file("empty", "")), Contains("not a gmsh mesh"));
  CHECK_THAT(error_of(write_file("old", "$MeshFormat\n1 0 8\n$EndMeshFormat\n")), Contains("version 1;"));
}

TEST_CASE("damaged files") {
  for (const char* options : {"-format msh22", "-format msh41", "-format msh41 -bin"}) {
    const std::string text = text_of(make_mesh("cube", {}, options));
    for (const double part : {0.01, 0.3, 0.6, 0.97})
      CHECK_THAT(error_of(write_file("cut", text.substr(0, static_cast<std::size_t>(part * text.size())))),
                 Contains("damaged gmsh mesh"));
  }
}

TEST_CASE("no cells of three dimensions") {
  CHECK_THAT(error_of(write_file("flat", two_tetrahedra(skin))), Contains("no three-dimensional cells"));
}

TEST_CASE("a hole is found with its place in the units of the file") {
  std::vector<std::string> open = skin;
  open.erase(open.begin() + 1);
  const std::string message = error_of(write_file("hole", two_tetrahedra(open + cells)), 0.001);
  CHECK_THAT(message, Contains("a hole") && Contains("faces: 1;") && Contains("(0.433333, 0.433333, 0.333333), cell 0"));
}

TEST_CASE("cells without physical volume") {
  const std::vector<std::string> one_without{"4 2 2 1 1 2 3 4", "4 2 0 1 1 3 2 5"}, none{"4 2 0 1 1 2 3 4", "4 2 0 1 1 3 2 5"};
  CHECK_THAT(error_of(write_file("no_volume", two_tetrahedra(skin + one_without))),
             Contains("1 cells belong to no physical volume, the first is cell 1"));
  const Mesh mesh = read_mesh(write_file("no_volumes", two_tetrahedra(skin + none)), 1, PETSC_COMM_WORLD);
  REQUIRE(mesh.zones.size() == 1);
  CHECK(mesh.zones[0].name == "domain");
}

TEST_CASE("inverted and flat cells") {
  const std::vector<std::string> inverted{"4 2 2 1 1 2 3 4", "4 2 2 1 1 2 3 5"};
  CHECK_THAT(error_of(write_file("inverted", two_tetrahedra(skin + inverted)), 0.1),
             Contains("1 cells (of 2) are inverted or flat; the first is cell 1 at (0, 0, 0) with volume -0.167"));
  CHECK_THAT(error_of(write_file("squashed", two_tetrahedra(skin + cells, "0.3 0.3 0"))),
             Contains("inverted or flat; the first is cell 1"));
}

TEST_CASE("elements that do not fit together") {
  CHECK_THAT(error_of(write_file("twice", two_tetrahedra(skin + cells + cells))), Contains("more than two cells"));
  CHECK_THAT(error_of(write_file("stray", two_tetrahedra(skin + cells + std::vector<std::string>{"2 2 1 1 1 4 5"}))),
             Contains("do not fit together"));
}

TEST_CASE("named surfaces inside a zone, and zones that meet without a name") {
  const std::vector<std::string> wall{"2 2 1 1 1 2 3"};
  CHECK_THAT(error_of(write_file("inside", two_tetrahedra(skin + wall + cells))),
             Contains("inside a physical volume") && Contains("(0.333333, 0.333333, 0)"));
  CHECK_THAT(error_of(make_mesh("two_zones", {{"named", 0}})), Contains("faces between two physical volumes"));
}

TEST_CASE("periodic surfaces too close, or matched at the edges only") {
  CHECK_THAT(error_of(make_mesh("box", {{"nx", 2}, {"nz", 1}, {"px", 1}})), Contains("three cells"));
  CHECK_THAT(error_of(make_mesh("box", {{"nx", 1}, {"nz", 1}, {"px", 1}})), Contains("three cells") || Contains("do not fit"));
  CHECK_THAT(error_of(make_mesh("box", {{"nz", 3}, {"px", 1}})), Contains("matched at their edges only"));
}

TEST_CASE("two cells on the same side of their face are told with the place", "[mesh][errors]") {
  const std::string file =
      write_file("overlap", two_tetrahedra(skin + std::vector<std::string>{"4 2 2 1 1 2 3 4", "4 2 2 1 1 2 3 5"}, "0.3 0.3 0.5"));
  CHECK_THAT(error_of(file), Contains("cells overlap") && Contains("(0.333333, 0.333333, 0)"));
}
