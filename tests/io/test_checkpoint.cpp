#include <catch2/catch.hpp>
#include <fstream>

#include "file_size_limit.h"
#include "io/checkpoint.h"
#include "io/file.h"
#include "scratch.h"

using namespace windhover;
using Catch::Contains;

namespace {

constexpr int columns = 5;
const MPI_Comm comm = MPI_COMM_WORLD;

/// Ranks hold different numbers of rows: rank r has 1000 + 7 r.
std::int64_t my_rows() { return 1000 + 7 * rank_of(comm); }
std::int64_t my_first() {
  std::int64_t first = 0;
  for (int r = 0; r < rank_of(comm); ++r) first += 1000 + 7 * r;
  return first;
}
std::vector<double> my_values(double scale) {
  std::vector<double> values(my_rows() * columns);
  for (size_t i = 0; i < values.size(); ++i) values[i] = scale / (1.0 + my_first() * columns + i);
  return values;
}

std::filesystem::path write(const std::filesystem::path& directory, std::int64_t step) {
  io::CheckpointWriter writer(directory, step, comm);
  writer.attribute("step", step);
  writer.attribute("time_s", 0.1 * step);
  writer.attribute("mesh_hash", std::uint64_t(0xfedcba9876543210));
  writer.attribute("zone", "fluid");
  writer.attribute("pose_R", std::vector<double>{1, 0, 0.3});
  writer.array("q", my_values(step), columns);
  writer.finish();
  return *io::newest_checkpoint(directory);
}

}  // namespace

TEST_CASE("a checkpoint reads back exactly", "[io]") {
  const testing::Scratch scratch;
  CHECK(!io::newest_checkpoint(scratch.path));
  const io::CheckpointReader reader(write(scratch.path, 12), comm);
  CHECK(reader.attribute<std::int64_t>("step") == 12);
  CHECK(reader.attribute<double>("time_s") == 0.1 * 12);
  CHECK(reader.attribute<std::uint64_t>("mesh_hash") == 0xfedcba9876543210);
  CHECK(reader.attribute<std::string>("zone") == "fluid");
  CHECK(reader.attribute<std::vector<double>>("pose_R") == std::vector<double>{1, 0, 0.3});
  CHECK(reader.has_array("q"));
  CHECK(!reader.has_array("q_previous"));
  CHECK(reader.array("q", columns, my_first(), my_rows()) == my_values(12));
  CHECK_THROWS_WITH(reader.attribute<double>("speed"), Contains("no attribute speed"));
  CHECK_THROWS_WITH(reader.attribute<std::string>("step"), Contains("another type"));
  CHECK_THROWS_WITH(reader.array("q", 4, my_first(), my_rows()), Contains("expected 4 columns"));
  CHECK_THROWS_WITH(reader.array("p", 4, 0, 1), Contains("no table p"));
}

TEST_CASE("the two newest checkpoints are kept", "[io]") {
  const testing::Scratch scratch;
  for (int step : {1, 2, 30}) write(scratch.path, step);
  MPI_Barrier(comm);
  const auto folder = scratch.path / "checkpoint";
  CHECK(!std::filesystem::exists(folder / "step_00000001.h5"));
  CHECK(std::filesystem::exists(folder / "step_00000002.h5"));
  CHECK(io::newest_checkpoint(scratch.path) == folder / "step_00000030.h5");
}

TEST_CASE("a checkpoint cut short and a foreign file are refused", "[io]") {
  const testing::Scratch scratch;
  const auto path = write(scratch.path, 3);
  const auto size = std::filesystem::file_size(path);
  for (double fraction : {0.95, 0.5, 0.02}) {
    MPI_Barrier(comm);
    if (rank_of(comm) == 0) std::filesystem::resize_file(path, std::uintmax_t(fraction * size));
    MPI_Barrier(comm);
    CHECK_THROWS_AS(io::CheckpointReader(path, comm), UserError);
    CHECK_THROWS_WITH(io::CheckpointReader(path, comm), Contains(path.string()));
  }
  MPI_Barrier(comm);
  if (rank_of(comm) == 0) std::ofstream(path) << "not HDF5 at all\n";
  MPI_Barrier(comm);
  CHECK_THROWS_WITH(io::CheckpointReader(path, comm), Contains("no checkpoint"));
  CHECK_THROWS_WITH(io::CheckpointReader(scratch.path / "missing.h5", comm), Contains("cannot be read"));
}

TEST_CASE("a full disk leaves the last checkpoint whole and nothing else", "[io]") {
  const testing::Scratch scratch;
  write(scratch.path, 1);
  for (rlim_t limit : {1000, 200000, 300000}) {
    {
      const testing::FileSizeLimit full(limit);
      CHECK_THROWS_WITH(write(scratch.path, 2),
                        Contains("step_00000002.h5") && Contains("cannot write") && Contains("File too large"));
    }
    MPI_Barrier(comm);
    int files = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(scratch.path / "checkpoint")) ++files;
    CHECK(files == 1);
    const io::CheckpointReader reader(*io::newest_checkpoint(scratch.path), comm);
    CHECK(reader.array("q", columns, my_first(), my_rows()) == my_values(1));
  }
  const io::CheckpointReader reader(write(scratch.path, 2), comm);  // and the next one succeeds
  CHECK(reader.array("q", columns, my_first(), my_rows()) == my_values(2));
}
