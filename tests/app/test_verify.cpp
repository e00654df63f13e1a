#include "app/verify.h"

#include <catch2/catch.hpp>
#include <fstream>

#include "../io/scratch.h"
#include "base/errors.h"

using namespace windhover;
using app::Verdict;
using Catch::Contains;

namespace {

app::VerifyTable load(const std::string& text) {
  const testing::Scratch scratch;
  const auto path = scratch.path / "verify.toml";
  std::ofstream(path) << text;
  return app::load_verify(path);
}

}  // namespace

TEST_CASE("verify: each figure is judged by its bounds", "[app]") {
  const auto table = load(R"(
[[run]]
name = "coarse"
quick = true
[[run]]
name = "fine"
set = ["mesh.parameters.n=64"]
ranks = 2
[[figure]]
name = "order"
min = 1.9
needs = ["coarse", "fine"]
[[figure]]
name = "drag"
expected = 0.1
tolerance = 0.01
max = 0.105
)");
  REQUIRE(table.runs.size() == 2);
  CHECK(table.runs[1].ranks == 2);
  const auto &order = table.figures[0], &drag = table.figures[1];
  CHECK(app::allowed_text(order) == "≥ 1.9");
  CHECK(app::allowed_text(drag) == "0.09 to 0.105");
  const auto result = [&](const app::VerifyFigure& figure, const nlohmann::json& values) {
    return app::judge(figure, values, table.runs).result;
  };
  CHECK(result(order, {{"order", 2.0}}) == Verdict::Result::holds);
  CHECK(result(order, {{"order", 1.8}}) == Verdict::Result::fails);
  CHECK(result(order, {{"ordre", 2.0}}) == Verdict::Result::missing);
  CHECK(result(order, {{"order", nullptr}}) == Verdict::Result::missing);
  CHECK(result(order, {{"order", NAN}}) == Verdict::Result::fails);
  CHECK(result(drag, {{"drag", 0.095}}) == Verdict::Result::holds);
  CHECK(result(drag, {{"drag", 0.106}}) == Verdict::Result::fails);
  CHECK(app::judge(order, {{"order", 2.0}}, {table.runs[0]}).result == Verdict::Result::skipped);
}

TEST_CASE("verify: tables that say nothing or name unknown runs are refused", "[app]") {
  CHECK_THROWS_WITH(load("[[figure]]\nname = \"a\"\nexpected = 1\n"), Contains("without tolerance, min or max"));
  CHECK_THROWS_WITH(load("[[figure]]\nname = \"a\"\ntolerance = 1\n"), Contains("tolerance needs expected"));
  CHECK_THROWS_WITH(load("[[run]]\nname = \"fine\"\n[[figure]]\nname = \"a\"\nmin = 1\nneeds = [\"fin\"]\n"),
                    Contains("verify.toml:3") && Contains("unknown run \"fin\" (did you mean \"fine\"?)"));
  CHECK_THROWS_WITH(load("[[run]]\nname = \"../x\"\n"), Contains("name of a results folder"));
}
