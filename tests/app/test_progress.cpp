#include "app/progress.h"

#include <catch2/catch.hpp>

#include "../io/scratch.h"
#include "io/file.h"

using namespace windhover;

TEST_CASE("progress: plain lines where there is no terminal, few of them, the last always", "[app]") {
  const testing::Scratch scratch;
  const auto path = scratch.path / "log";
  std::FILE* log = std::fopen(path.c_str(), "w");
  {
    app::Progress progress(0, 10, MPI_COMM_WORLD, log);
    for (int step = 1; step <= 100; ++step) progress.report({step, 0.1 * step, 3, 25});
  }
  std::fclose(log);
  const std::string text = io::read_text(path);
  CHECK(std::count(text.begin(), text.end(), '\n') == 2);
  CHECK_THAT(text, Catch::StartsWith("step      1  t 0.1         s    1.0 %  left 0:00:0"));
  CHECK_THAT(text, Catch::Contains("\nstep    100  t 10          s  100.0 %  left 0:00:00  newton 3  krylov 25\n"));
}

TEST_CASE("progress: coupling iterations where there are any", "[app]") {
  CHECK_THAT(app::progress_line({1, 1, 3, 25, 4}, 0.5, 1), Catch::EndsWith("newton 3  krylov 25  coupling 4"));
  CHECK_THAT(app::progress_line({1, 1, 3, 25}, 0.5, 1), Catch::EndsWith("newton 3  krylov 25"));
  CHECK_THAT(app::progress_line({1, 1, 3, 25, 4, "pitch -5 deg"}, 0.5, 1), Catch::EndsWith("coupling 4  pitch -5 deg"));
}

TEST_CASE("progress: time left", "[app]") {
  CHECK_THAT(app::progress_line({1, 1, 0, 0}, 0.25, 3600), Catch::Contains("25.0 %  left 3:00:00"));
  CHECK_THAT(app::progress_line({0, 0, 0, 0}, 0, 1), Catch::Contains("left ?"));
}
