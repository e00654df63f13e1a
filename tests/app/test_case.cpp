#include "app/case.h"

#include <catch2/catch.hpp>
#include <fstream>

#include "../io/scratch.h"
#include "app/study_table.h"
#include "app/verify.h"
#include "base/errors.h"
#include "io/file.h"

using namespace windhover;
using app::load_case;
using Catch::Contains;

namespace {

const std::string minimal = R"([mesh]
geometry = "../box.geo"
parameters = {n = 32, aspect = 1.5}
[fluid.boundary]
outer = "farfield"
"upper wall" = "wall"
hull = "wall"
[[body.motion]]
kind = "rotation"
rate_deg_s = -10
[[body.motion]]
amplitude_m = 2
frequency_hz = 3
phase_deg = 90
[time]
step_deg = 2
steps = 10
)";

struct CaseFile {
  explicit CaseFile(const std::string& text) {
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path) << text;
  }
  testing::Scratch scratch;
  std::filesystem::path path = scratch.path / "flap/case.toml";
};

/// The message that a case with this override gives.
std::string error_of(const std::string& override_text, const std::string& text = minimal) {
  const CaseFile file(text);
  try {
    load_case(file.path, {override_text});
  } catch (const UserError& error) {
    return error.what();
  }
  return "no error";
}

std::string error_in(const std::string& text) {
  const CaseFile file(text);
  try {
    load_case(file.path);
  } catch (const UserError& error) {
    const std::string message = error.what();
    return message.starts_with(file.path.string()) ? message.substr(file.path.string().size()) : message;
  }
  return "no error";
}

}  // namespace

TEST_CASE("a case is read and completed", "[app]") {
  const CaseFile file(minimal);
  const auto c = load_case(file.path);
  CHECK(c.name == "flap");
  CHECK(c.output.directory == "results/flap");
  CHECK(c.mesh.geometry == (file.scratch.path / "box.geo").string());
  CHECK(c.mesh.file == (file.scratch.path / "box_aspect1.5_n32.msh").string());
  CHECK(c.fluid.gamma == 1.4);
  CHECK(c.fluid.pressure_Pa() == Approx(101323).epsilon(1e-4));
  CHECK(c.body.walls == std::vector<std::string>{"hull", "upper wall"});
  CHECK(app::step_seconds(c) == Approx(0.2));
  CHECK(app::step_count(c) == 10);
  CHECK(app::end_seconds(c) == Approx(2));
}

TEST_CASE("motions become those of the mesh, in radians", "[app]") {
  const CaseFile file(minimal);
  const auto motion = app::body_motion(load_case(file.path));
  REQUIRE(motion.size() == 2);
  const auto& rotation = std::get<mesh::Rotation>(motion[0]);
  CHECK(rotation.angle.derivative(0) == Approx(-10 * M_PI / 180));
  const auto& translation = std::get<mesh::Translation>(motion[1]);
  CHECK(translation.distance.value(0) == Approx(2));
  CHECK(translation.distance.value(1 / 6.0) == Approx(-2));
}

TEST_CASE("time: other ways to give step and end", "[app]") {
  const CaseFile file(minimal);
  std::string text = minimal;
  text.replace(text.find("step_deg = 2\nsteps = 10"), 23, "step_nondim = 0.5\nend_s = 1");
  const CaseFile other(text);
  const auto c = load_case(other.path, {"fluid.length_m=2", "fluid.sound_speed_m_s=10"});
  CHECK(app::step_seconds(c) == Approx(0.1));
  CHECK(app::step_count(c) == 10);
  CHECK(app::end_seconds(c) == 1);
}

TEST_CASE("overrides: values, bare words, elements of arrays", "[app]") {
  const CaseFile file(minimal);
  const auto c = load_case(file.path, {"fluid.flux=hllc", "time.steps=7", "body.motion[1].frequency_hz=0.5",
                                       "wind.velocity_m_s=[1,2,3]", "mesh.parameters.n=4", "mesh.file=a b.msh"});
  CHECK(c.fluid.flux == "hllc");
  CHECK(c.time.steps == 7);
  CHECK(c.body.motion[1].frequency_hz == 0.5);
  CHECK(c.body.motion[1].amplitude_m == 2);
  CHECK(c.wind.velocity_m_s == Eigen::Vector3d(1, 2, 3));
  CHECK(c.mesh.parameters.at("aspect") == 1.5);
  CHECK(c.mesh.file == (file.scratch.path / "flap/a b.msh").string());
  CHECK(load_case(file.path, {"mesh.parameters={m=1}"}).mesh.parameters == std::map<std::string, double>{{"m", 1}});
}

TEST_CASE("the effective case reads back as the same case", "[app]") {
  const CaseFile file(minimal);
  const auto c = load_case(file.path, {"fluid.initial.kind=riemann", "fluid.initial.left.pressure_Pa=0.1",
                                         "zone=[{name = 'rotor', parent = 'air', radius_m = 1, to_m = 1}]"});
  const std::string text = app::effective_case(c);
  CHECK_THAT(text, Contains("limiter_epsilon = 0.01\n") && Contains("written by windhover"));
  const CaseFile copy(text);
  CHECK(app::effective_case(load_case(copy.path)) == text);
}

TEST_CASE("wrong cases: the message names place, key, value and what is allowed", "[app]") {
  CHECK(error_of("") == "--set : expected key=value");
  CHECK(error_of("fluid.gama=2") == "--set fluid.gama=2: fluid.gama: unknown key (did you mean \"gamma\"?)");
  CHECK_THAT(error_of("fluidd.gamma=2"), Contains("fluidd: unknown section (did you mean \"fluid\"?)"));
  CHECK_THAT(error_of("propeller=[]"), Contains("propeller: unknown section"));
  CHECK_THAT(error_of("fluid.gamma=0.5"), Contains("fluid.gamma = 0.5: must be > 1"));
  CHECK_THAT(error_of("fluid.gamma=x"), Contains("fluid.gamma = \"x\": expected a number"));
  CHECK_THAT(error_of("fluid.gamma=nan"), Contains("must be finite"));
  CHECK_THAT(error_of("fluid.flux=rooe"),
             Contains("fluid.flux = \"rooe\": must be one of \"roe\", \"hllc\", \"slau2\" (did you mean \"roe\"?)"));
  CHECK_THAT(error_of("fluid.low_mach=1"), Contains("expected true or false"));
  CHECK_THAT(error_of("time.steps=1.5"), Contains("expected an integer"));
  CHECK_THAT(error_of("time.steps=99999999999"), Contains("expected an integer"));
  CHECK_THAT(error_of("time.step_s=1"),
             Contains("exactly one of step_s, step_deg, step_nondim is needed, 2 are given"));
  CHECK_THAT(error_of("time.end_s=1"), Contains("exactly one of steps and end_s is needed, both are given"));
  CHECK_THAT(error_of("body.motion[0].rate_deg_s=0"), Contains("time.step_deg = 2: needs"));
  CHECK_THAT(error_of("body.motion[0].mean_m=1"),
             Contains("body.motion[0].mean_m: unknown key for kind = \"rotation\" (did you mean \"mean_deg\"?)"));
  CHECK_THAT(error_of("body.motion[2].mean_m=1"), Contains("elements 0 to 1"));
  CHECK_THAT(error_of("body.motion[0].axis=[0,0,0]"), Contains("has no direction"));
  CHECK_THAT(error_of("body.motion=1"), Contains("expected an array of tables: [[body.motion]]"));
  CHECK_THAT(error_of("body.moment_point_m=[1,2]"), Contains("expected three numbers"));
  CHECK_THAT(error_of("body.walls=[\"hul\"]"), Contains("\"hul\" is not a wall") && Contains("did you mean \"hull\"?"));
  CHECK_THAT(error_of("fluid.boundary.outer=far"), Contains("must be one of \"wall\", \"farfield\", \"symmetry\""));
  CHECK_THAT(error_of("mesh.geometry="), Contains("one of mesh.file, mesh.geometry, [airframe] and a [[rotor]] with blades is needed"));
  CHECK_THAT(error_of("mesh.parameters.n=many"), Contains("mesh.parameters.n = \"many\": expected a number"));
}

TEST_CASE("wrong cases: the place is the line of the file", "[app]") {
  CHECK(error_in("[fluid]\n\ngamma = \"a\"\n") == ":3: fluid.gamma = \"a\": expected a number");
  CHECK(error_in("[fluid]\nflux = 3\n") == ":2: fluid.flux = 3: must be one of \"roe\", \"hllc\", \"slau2\"");
  CHECK_THAT(error_in("[fluid]\ngamma = = 3\n"), Contains(":2: not valid TOML"));
  CHECK_THAT(error_in(minimal + "[solver]\nnewton_itrations = 3\n"),
             Contains(":19: solver.newton_itrations: unknown key (did you mean \"newton_iterations\"?)"));
  CHECK_THROWS_WITH(load_case("/none/case.toml"), "/none/case.toml: cannot read this file");
}

TEST_CASE("a case like another: its keys over those of the other, elements of arrays by number", "[app]") {
  const CaseFile base(minimal);
  const auto other = base.path.parent_path() / "slow.toml";
  std::ofstream(other) << "like = \"case.toml\"\n[body.motion.0]\nrate_deg_s = -5\n[time]\nsteps = 7\n";
  const app::Case c = load_case(other, {"body.motion[1].amplitude_m=4"});
  CHECK(c.name == "slow");
  CHECK(c.body.motion[0].rate_deg_s == -5);
  CHECK(c.body.motion[0].kind == "rotation");
  CHECK(c.body.motion[1].amplitude_m == 4);
  CHECK(c.body.motion[1].frequency_hz == 3);
  CHECK(c.time.steps == 7);
  CHECK(c.time.step_deg == 2.0);
  CHECK(c.mesh.file == load_case(base.path).mesh.file);
  CHECK_THAT(error_in("like = \"../case.toml\"\n"), Contains(":1: like = \"../case.toml\": must be a file in the folder"));
  CHECK_THAT(error_in("like = \"none.toml\"\n"), Contains("none.toml: cannot read this file"));
  CHECK_THAT(error_in("like = \"case.toml\"\n"), Contains("this file is itself like another"));
}

TEST_CASE("every case of the project is read", "[app]") {
  int read = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(WINDHOVER_SOURCE_DIR "/cases")) {
    const auto& file = entry.path();
    if (file.extension() != ".toml" || file.filename() == "verify.toml" || file.filename() == "study.toml" || file.stem().extension() == ".msh") continue;
    INFO(file);
    CHECK_NOTHROW(load_case(file));
    ++read;
  }
  CHECK(read > 15);
}

TEST_CASE("docs/case-file.md is current", "[app]") {
  INFO("renew it with `windhover keys > docs/case-file.md`");
  CHECK(io::read_text(WINDHOVER_SOURCE_DIR "/docs/case-file.md") ==
        app::case_file_documentation() + app::verify_documentation() + app::study_documentation());
}
