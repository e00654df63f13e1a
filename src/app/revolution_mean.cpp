#include "app/revolution_mean.h"

#include <algorithm>
#include <cassert>

namespace windhover::app {

void RevolutionMean::integrate(double duration_s, std::span<const double> from, std::span<const double> to) {
  for (std::size_t i = 0; i < sum_.size(); ++i) sum_[i] += duration_s * (from[i] + to[i]) / 2;
  elapsed_s_ += duration_s;
}

std::optional<Revolution> RevolutionMean::add(double time_s, double turned_deg, std::span<const double> values) {
  assert(values.size() == last_.size());
  const double step = started_ ? time_s - time_s_ : 0, before = angle_deg_;
  const std::vector<double> from = last_;
  started_ = true;
  time_s_ = time_s;
  last_.assign(values.begin(), values.end());
  angle_deg_ += turned_deg;
  if (angle_deg_ < 360) {
    integrate(step, from, last_);
    return {};
  }
  const double share = (360 - before) / turned_deg;
  std::vector<double> at_end(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) at_end[i] = from[i] + share * (last_[i] - from[i]);
  integrate(share * step, from, at_end);
  latest_ = {latest_ ? latest_->number + 1 : 1, time_s - (1 - share) * step, elapsed_s_, sum_};
  for (double& mean : latest_->mean) mean /= elapsed_s_;
  std::fill(sum_.begin(), sum_.end(), 0);
  elapsed_s_ = 0;
  angle_deg_ -= 360;
  integrate((1 - share) * step, at_end, last_);
  return latest_;
}

std::vector<double> RevolutionMean::state() const {
  const Revolution latest = latest_.value_or(Revolution{0, 0, 0, std::vector<double>(sum_.size(), 0)});
  std::vector<double> state = {started_ ? time_s_ : -1, angle_deg_, elapsed_s_, double(latest.number), latest.end_s, latest.period_s};
  for (const auto* list : {&last_, &sum_, &latest.mean}) state.insert(state.end(), list->begin(), list->end());
  return state;
}

void RevolutionMean::restore(std::span<const double> state) {
  const std::size_t n = sum_.size();
  assert(state.size() == state_size());
  started_ = state[0] >= 0;
  time_s_ = state[0], angle_deg_ = state[1], elapsed_s_ = state[2];
  const auto list = [&](std::size_t i) {
    const auto part = state.subspan(6 + i * n, n);
    return std::vector<double>(part.begin(), part.end());
  };
  last_ = list(0), sum_ = list(1);
  latest_.reset();
  if (state[3] > 0) latest_ = {static_cast<long>(state[3]), state[4], state[5], list(2)};
}

}  // namespace windhover::app
