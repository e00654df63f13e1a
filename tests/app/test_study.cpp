#include <catch2/catch.hpp>
#include <fstream>

#include "../io/scratch.h"
#include "app/study_progress.h"
#include "app/study_table.h"
#include "io/file.h"

using namespace windhover;

namespace {

/// The runs that a study of a box makes, each with what it sets.
std::map<std::string, std::vector<std::string>> runs(const std::string& text) {
  const testing::Scratch scratch;
  std::ofstream(scratch.path / "case.toml") << "[mesh]\nfile = \"box.msh\"\n[fluid]\nboundary = {sides = \"farfield\"}\n"
                                               "[time]\nstep_s = 0.1\nsteps = 4\n";
  std::ofstream(scratch.path / "box.toml") << text << "\n[[figure]]\nname = \"force\"\nentry = \"fx_N\"\n";
  std::map<std::string, std::vector<std::string>> made;
  for (const auto& point : app::load_study(scratch.path / "box.toml").points) made[point.name] = point.overrides;
  return made;
}

}  // namespace

TEST_CASE("study: every combination of the swept keys, the last changing fastest", "[app]") {
  const testing::Scratch scratch;
  const auto made = runs(R"(
reference = "flux=roe,step_s=0.1,velocity_m_s=1,0,0"
[sweep]
fluid.flux = ["roe", "hllc"]
time.step_s = [0.1, 0.05]
wind.velocity_m_s = [[1, 0, 0], [-2.1, 0, 0]])");
  CHECK(made.size() == 8);
  CHECK(made.at("flux=hllc,step_s=0.05,velocity_m_s=-2.1,0,0") ==
        std::vector<std::string>{"fluid.flux=\"hllc\"", "time.step_s=0.05", "wind.velocity_m_s=[-2.1, 0, 0]"});
}

TEST_CASE("study: a run is made for the swept keys that it does not set", "[app]") {
  const auto made = runs(R"(
set = ["time.steps=3"]
[sweep]
time.step_s = [0.1, 0.05]
solver.krylov_tolerance = [0.1, 0.01]
[[run]]
name = "usual"
[[run]]
name = "fine"
set = ["time.step_s=0.01", "solver.krylov_tolerance=0.001"]
[[run]]
name = "half"
set = ["time.step_s=0.025"])");
  CHECK(made.size() == 4 + 1 + 2);
  CHECK(made.at("fine") == std::vector<std::string>{"time.steps=3", "time.step_s=0.01", "solver.krylov_tolerance=0.001"});
  CHECK(made.at("half,krylov_tolerance=0.01") ==
        std::vector<std::string>{"time.steps=3", "solver.krylov_tolerance=0.01", "time.step_s=0.025"});
}

TEST_CASE("study: names tell keys that end alike apart", "[app]") {
  const auto made = runs(R"(
reference = "coupling.tolerance=0.1,trim.tolerance=0.5"
[sweep]
coupling.tolerance = [0.1]
trim.tolerance = [0.5])");
  CHECK(made.count("coupling.tolerance=0.1,trim.tolerance=0.5") == 1);
}

TEST_CASE("study: bar and time left", "[app]") {
  CHECK(app::study_bar(2, 4, "fine", 0.5, 0.25, 61) == "[######..................] 2/4  fine  50 %  left 0:01:01");
  CHECK(app::study_bar(1, 4, "fine", 0, 0, -1) == "[........................] 1/4  fine  0 %  left ?");
}
