#include <catch2/catch.hpp>

#include "file_size_limit.h"
#include "io/csv.h"
#include "io/results.h"
#include "scratch.h"

using namespace windhover;
using Catch::Contains;

namespace {

const MPI_Comm comm = MPI_COMM_WORLD;
const std::vector<std::string> columns = {"step", "time_s", "fx_N"};

void append(io::CsvTable& table, std::initializer_list<double> row) { table.append(std::vector<double>(row)); }

}  // namespace

TEST_CASE("csv: rows are in the file at once and read back exactly", "[io]") {
  const testing::Scratch scratch;
  const auto path = scratch.path / "history.csv";
  io::CsvTable table(path, columns, comm);
  append(table, {0, 0, -1.0 / 3});
  append(table, {1, 0.1, 1e-300});
  CHECK(io::read_text(path) == "step,time_s,fx_N\n0,0,-0.3333333333333333\n1,0.1,1e-300\n");
}

TEST_CASE("csv: a restart cuts back to its step", "[io]") {
  const testing::Scratch scratch;
  const auto path = scratch.path / "history.csv";
  {
    io::CsvTable table(path, columns, comm);
    for (int step = 0; step < 5; ++step) append(table, {double(step), 0.1 * step, 2});
  }
  MPI_Barrier(comm);
  if (rank_of(comm) == 0) io::OutputFile(path, io::OutputFile::Mode::append).write("2,0.2");  // killed while writing
  MPI_Barrier(comm);
  {
    io::CsvTable table(path, columns, comm, 2);
    append(table, {3, 7, 7});
  }
  CHECK(io::read_text(path) == "step,time_s,fx_N\n0,0,2\n1,0.1,2\n2,0.2,2\n3,7,7\n");
  CHECK_THROWS_WITH(io::CsvTable(path, {"step", "x"}, comm, 2), Contains("other columns"));
  CHECK_THROWS_WITH(io::CsvTable(scratch.path / "none.csv", columns, comm, 2), Contains("none.csv"));
}

TEST_CASE("csv: a full disk is an error on every rank and leaves whole rows", "[io]") {
  const testing::Scratch scratch;
  const auto path = scratch.path / "history.csv";
  io::CsvTable table(path, columns, comm);
  append(table, {0, 0.5, 0.5});
  {
    const testing::FileSizeLimit full(30);
    CHECK_THROWS_WITH(append(table, {1, 1.0 / 3, 1.0 / 3}), Contains("history.csv") && Contains("File too large"));
  }
  append(table, {2, 1, 1});
  CHECK(io::read_text(path) == "step,time_s,fx_N\n0,0.5,0.5\n2,1,1\n");
}

TEST_CASE("a results folder that holds another run is refused", "[io]") {
  const testing::Scratch scratch;
  const auto folder = scratch.path / "a" / "b";
  io::prepare_results(folder, false, comm);
  io::prepare_results(folder, false, comm);
  io::CsvTable table(folder / "history.csv", columns, comm);
  CHECK_THROWS_WITH(io::prepare_results(folder, false, comm), Contains("--restart"));
  CHECK_NOTHROW(io::prepare_results(folder, true, comm));
  CHECK_THROWS_WITH(io::prepare_results(folder / "history.csv" / "c", false, comm), Contains("cannot make"));
}

TEST_CASE("json is replaced in one step", "[io]") {
  const testing::Scratch scratch;
  const auto path = scratch.path / "summary.json";
  io::write_json(path, {{"steps", 3}, {"cells", 10}}, comm);
  CHECK(io::read_text(path) == "{\n  \"steps\": 3,\n  \"cells\": 10\n}\n");
  const testing::FileSizeLimit full(5);
  CHECK_THROWS_WITH(io::write_json(path, {{"steps", 4}}, comm), Contains("summary.json"));
  CHECK(io::read_text(path) == "{\n  \"steps\": 3,\n  \"cells\": 10\n}\n");
  CHECK(!std::filesystem::exists(path.string() + ".tmp"));
}

TEST_CASE("csv: columns, without a last row that was cut short", "[io]") {
  const testing::Scratch scratch;
  const auto path = scratch.path / "history.csv";
  on_root(comm, [&] { io::write_atomically(path, "step,time_s\n0,0\n1,0.1\n2,0."); });
  const io::CsvColumns table(path);
  CHECK(table["time_s"] == std::vector<double>{0, 0.1});
  CHECK_THROWS_WITH(table["time"], Contains("history.csv") && Contains("no column \"time\"") && Contains("\"time_s\"?"));
}
