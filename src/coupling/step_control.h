// Sizes of steps: equal ones that recover from a refused step, or steps as large as a tolerance permits; never across an
// event.
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "coupling/window.h"

namespace windhover::coupling {

/// What linear loads over the last step leave out: the mean over that step of the difference to a quadratic, relative to
/// `scale`, the largest of the components that `responds` names; falls as dt². `points`: the step's end last, in order of
/// time. The quadratic goes through the last three; through four it is the one whose means over each pair of neighbours
/// are theirs, which an oscillation from step to step (Crank–Nicolson does not damp it) does not disturb. Nothing for fewer
/// than three.
std::optional<double> load_error(std::span<const body::LoadPolynomial::Point> points, const Eigen::VectorXd& scale,
                                 const Window::Responses& responds);

class StepControl {
 public:
  /// `tolerance` of a step's error; 0: steps are equal.
  explicit StepControl(double tolerance) : tolerance_(tolerance) {}

  /// The next step: at most `nominal`, of which the first of a run is `first_ratio`; it ends at `event` or so far before
  /// it that the step after it is no sliver.
  double propose(double nominal, double first_ratio, double t, double event) const;
  /// What to try after `dt` was refused, for its error or, without one, because it could not be solved.
  double refused(double dt, std::optional<double> error) const;
  void accepted(double dt, std::optional<double> error, double nominal);

  /// For a restart.
  std::vector<double> state() const { return {next_}; }
  void restore(std::span<const double> state) { next_ = state[0]; }

 private:
  double factor(double error) const;

  double tolerance_;
  double next_ = 0;  ///< as the last step suggests; 0: there was none
};

}  // namespace windhover::coupling
