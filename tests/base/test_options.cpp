#include "base/options.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace windhover;

TEST_CASE("the nearest valid name is found, a far one is not", "[base]") {
  const std::vector<std::string> names = {"gamma", "flux", "limiter", "limiter_epsilon"};
  CHECK(nearest_name("gama", names) == "gamma");
  CHECK(nearest_name("limitr", names) == "limiter");
  CHECK(nearest_name("limiter_epsilo", names) == "limiter_epsilon");
  CHECK(nearest_name("temperature", names) == "");
  CHECK(nearest_name("x", names) == "");
  CHECK(suggestion("gama", names) == " (did you mean \"gamma\"?)");
  CHECK(suggestion("x", {"a", "b"}) == " (valid: \"a\", \"b\")");
  CHECK(suggestion("x", {}) == "");
}

TEST_CASE("ranges", "[base]") {
  const Key positive = {.doc = "", .above = 0, .max = 2};
  CHECK(!in_range(positive, 0));
  CHECK(in_range(positive, 2));
  CHECK(!in_range(positive, 2.1));
  CHECK(!in_range({}, NAN));
  CHECK(!in_range({}, INFINITY));
  CHECK(range_text(positive) == "> 0, ≤ 2");
  CHECK(range_text({}) == "");
}
