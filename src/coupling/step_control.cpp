#include "coupling/step_control.h"

#include <algorithm>
#include <cmath>

namespace windhover::coupling {
namespace {

using body::LoadPolynomial;
using Eigen::VectorXd;

constexpr double kGrowth = 2, kShrink = 0.2, kSafety = 0.8;
constexpr double kRoundOff = 1e-9;  // of a step

/// Half the second derivative of the quadratic.
VectorXd curvature(std::span<const LoadPolynomial::Point> p) {
  const size_t n = p.size();
  const auto slope = [&](size_t a, size_t b) -> VectorXd { return (p[b].loads - p[a].loads) / (p[b].t - p[a].t); };
  if (n == 3) return (slope(1, 2) - slope(0, 1)) / (p[2].t - p[0].t);
  return (slope(n - 3, n - 1) - slope(n - 4, n - 2)) / (p[n - 1].t + p[n - 3].t - p[n - 2].t - p[n - 4].t);
}

}  // namespace

std::optional<double> load_error(std::span<const LoadPolynomial::Point> points, const VectorXd& scale,
                                 const Window::Responses& responds) {
  if (points.size() < 3) return {};
  const VectorXd relative = curvature(points).cwiseQuotient(scale);
  const double dt = points.back().t - points[points.size() - 2].t;
  return responds.select(relative, VectorXd::Zero(scale.size())).lpNorm<Eigen::Infinity>() * dt * dt / 6;
}

double StepControl::propose(double nominal, double first_ratio, double t, double event) const {
  double dt = next_ > 0 ? std::min(nominal, next_) : first_ratio * nominal;
  if (dt > 0.999 * nominal) dt = nominal;
  const double room = event - t;
  if (room <= dt * (1 + kRoundOff)) return room;
  return tolerance_ > 0 && room < 2 * dt ? room / 2 : dt;
}

/// By which a step of this error may change, as the error is of second order.
double StepControl::factor(double error) const { return kSafety * std::sqrt(tolerance_ / error); }

double StepControl::refused(double dt, std::optional<double> error) const {
  return error ? dt * std::clamp(factor(*error), kShrink, kSafety) : dt / 2;
}

void StepControl::accepted(double dt, std::optional<double> error, double nominal) {
  if (tolerance_ == 0) {
    next_ = kGrowth * dt;
    return;
  }
  const double before = std::max(dt, std::min(next_, nominal));  // the event that cut a step says nothing of its error
  next_ = error ? std::min(kGrowth * before, dt * factor(*error)) : before;
}

}  // namespace windhover::coupling
