#include "io/fields.h"

#include <catch2/catch.hpp>
#include <cstdlib>

#include "file_size_limit.h"
#include "io/file.h"
#include "scratch.h"

using namespace windhover;
using Catch::Contains;

namespace {

const MPI_Comm comm = MPI_COMM_WORLD;

/// A unit cube with a tetrahedron on it, and one of the cube's faces as a wall of rank 0.
std::vector<io::FieldBlock> blocks() {
  io::FieldBlock fluid = {
      "fluid",
      {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1, 0.5, 0.5, 2 + 1e-9},
      {0, 1, 2, 3, 4, 5, 6, 7, 4, 5, 6, 8},
      {8, 12},
      {12, 10},
      {{"density_kg_m3", 1, {1.5F, float(rank_of(comm))}}, {"velocity_m_s", 3, {1, 2, 3, 4, 5, 6}}}};
  io::FieldBlock wall = {"wing & <tip>", {}, {}, {}, {}, {{"pressure_Pa", 1, {}}}};
  if (rank_of(comm) == 0) {
    wall = {"wing & <tip>", {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, {0, 1, 2, 3}, {4}, {9}, {{"pressure_Pa", 1, {7}}}};
  }
  return {fluid, wall};
}

}  // namespace

TEST_CASE("fields open in VTK, with zones as blocks and true times, also after a restart", "[io]") {
  const testing::Scratch scratch;
  {
    io::FieldWriter writer(scratch.path, comm);
    for (int step : {0, 20}) writer.write(step, 0.1 * step, blocks());
  }
  io::FieldWriter writer(scratch.path, comm, 10);
  writer.write(10, 1.0 / 3, blocks());
  if (rank_of(comm) == 0) {
    const std::string command = fmt::format("{} {}/tests/io/read_fields.py {} {}", WINDHOVER_PYTHON,
                                            WINDHOVER_SOURCE_DIR, scratch.path.string(), size_of(comm));
    CHECK(std::system(command.c_str()) == 0);
  }
}

TEST_CASE("fields: a full disk is an error on every rank and leaves the collection whole", "[io]") {
  const testing::Scratch scratch;
  io::FieldWriter writer(scratch.path, comm);
  writer.write(0, 0, blocks());
  const std::string before = io::read_text(scratch.path / "fields/fields.pvd");
  MPI_Barrier(comm);
  {
    const testing::FileSizeLimit full(1000);
    CHECK_THROWS_WITH(writer.write(1, 1, blocks()), Contains("fluid_0000.vtu") && Contains("File too large"));
  }
  CHECK(io::read_text(scratch.path / "fields/fields.pvd") == before);
}
