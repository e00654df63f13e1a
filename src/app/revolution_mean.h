// Means over the completed revolutions of a rotor.
#pragma once
#include <optional>
#include <span>
#include <vector>

namespace windhover::app {

/// One completed revolution: its means in time, values linear between steps, so that its ends need not be steps.
struct Revolution {
  long number = 0;  ///< from 1
  double end_s = 0, period_s = 0;
  std::vector<double> mean;
};

class RevolutionMean {
 public:
  explicit RevolutionMean(std::size_t n_values) : last_(n_values, 0), sum_(n_values, 0) {}

  /// The values at a time (s), and the angle in its own direction that the rotor has turned since the last call, less
  /// than a revolution. The first call is where the first revolution begins. Returns the revolution that this completes.
  std::optional<Revolution> add(double time_s, double turned_deg, std::span<const double> values);

  const std::optional<Revolution>& latest() const { return latest_; }
  const std::vector<double>& values() const { return last_; }

  /// All of this as numbers, for a checkpoint, and back; the same number of values is expected.
  std::vector<double> state() const;
  std::size_t state_size() const { return 6 + 3 * last_.size(); }
  void restore(std::span<const double> state);

 private:
  void integrate(double duration_s, std::span<const double> from, std::span<const double> to);

  bool started_ = false;
  double time_s_ = 0, angle_deg_ = 0;  ///< the latest time; the angle since the last completed revolution
  double elapsed_s_ = 0;               ///< the time since then
  std::vector<double> last_, sum_;     ///< the latest values; their integral since then
  std::optional<Revolution> latest_;
};

}  // namespace windhover::app
