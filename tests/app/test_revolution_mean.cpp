// Means over revolutions: exact for what is linear in time, wherever the steps fall.
#include <catch2/catch.hpp>

#include "app/revolution_mean.h"

using namespace windhover::app;

namespace {

constexpr double kRate = 40;  // degrees per second

/// A constant and the time itself, at steps that do not divide a revolution.
std::vector<Revolution> run(RevolutionMean& mean, double from_s, double to_s, double step_s) {
  std::vector<Revolution> all;
  double last = from_s;
  for (int i = 0; last < to_s; ++i) {
    const double t = from_s + i * step_s;
    if (auto r = mean.add(t, kRate * (t - last), std::vector<double>{3, t})) all.push_back(*r);
    last = t;
  }
  return all;
}

}  // namespace

TEST_CASE("the mean of a revolution does not depend on where the steps fall") {
  RevolutionMean mean(2);
  const auto revolutions = run(mean, 1, 30, 0.7);
  REQUIRE(revolutions.size() == 3);
  for (size_t k = 0; k < 3; ++k) {
    CHECK(revolutions[k].number == long(k + 1));
    CHECK(revolutions[k].period_s == Approx(9));
    CHECK(revolutions[k].end_s == Approx(1 + 9 * (k + 1)));
    CHECK(revolutions[k].mean[0] == Approx(3));
    CHECK(revolutions[k].mean[1] == Approx(1 + 9 * (k + 0.5)));
  }
  CHECK(mean.latest()->number == 3);
}

TEST_CASE("means continue from a state to the last bit") {
  RevolutionMean whole(2), second(2);
  run(whole, 0, 4, 0.5);
  second.restore(whole.state());
  CHECK(second.state() == whole.state());
  CHECK(!second.latest());
  for (double t = 5; t < 25; t += 0.5) {
    const auto a = whole.add(t, 20, std::vector<double>{t, t * t}), b = second.add(t, 20, std::vector<double>{t, t * t});
    CHECK(a.has_value() == b.has_value());
  }
  CHECK(second.state() == whole.state());
  CHECK(second.latest()->mean == whole.latest()->mean);
}

TEST_CASE("turning back completes nothing") {
  RevolutionMean mean(1);
  const std::vector<double> value = {1};
  mean.add(0, 0, value);
  CHECK(!mean.add(1, 300, value));
  CHECK(!mean.add(2, -100, value));
  CHECK(!mean.add(3, 100, value));
  const auto revolution = mean.add(4, 120, value);
  REQUIRE(revolution);
  CHECK(revolution->period_s == Approx(3.5));
}
