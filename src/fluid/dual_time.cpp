#include "fluid/dual_time.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fluid/rational_runge_kutta.h"

namespace windhover::fluid {

DualTime::DualTime(EulerOperator& euler, const DualTimeOptions& options)
    : euler_(euler),
      options_(options),
      round_off_(euler),
      first_(euler.make_vector()),
      second_(euler.make_vector()),
      middle_(euler.make_vector()),
      step_per_volume_(euler.mesh().n_owned) {}

void DualTime::set_pseudo_steps(const StageEquation& equation, Vec q) {
  const std::vector<double> radius = euler_.spectral_radii(q, equation.frames);
  const Combination& c = equation.combination;
  for (mesh::Index i = 0; i < euler_.mesh().n_owned; ++i)
    step_per_volume_[i] = 1 / (c.mass * euler_.mesh().volume[i] + c.rate * radius[i] / options_.cfl);
}

/// |F(q)|; F stays in first_.
double DualTime::residual_norm(const StageEquation& equation, Vec q) {
  euler_.residual(q, equation.frames, first_, equation.combination);
  double norm = 0;
  petsc(VecNorm(first_, NORM_2, &norm));
  return norm;
}

/// From F(q) in first_.
void DualTime::pseudo_step(const StageEquation& equation, Vec q) {
  const auto scale = [this](Vec f) {
    double* values = nullptr;
    petsc(VecGetArray(f, &values));
    for (mesh::Index c = 0; c < euler_.mesh().n_owned; ++c)
      for (int k = 0; k < kVariables; ++k) values[kVariables * c + k] *= -step_per_volume_[c];
    petsc(VecRestoreArray(f, &values));
  };
  scale(first_);
  petsc(VecWAXPY(middle_, 0.5, first_, q));
  euler_.residual(middle_, equation.frames, second_, equation.combination);
  scale(second_);
  rational_update(first_, second_, q);
}

StageReport DualTime::solve(const StageEquation& equation, Vec q, const StageScale& scale, int, int min_iterations) {
  const double started = MPI_Wtime(), floor = round_off_(equation.combination);
  set_pseudo_steps(equation, q);
  StageReport report;
  double norm = residual_norm(equation, q);
  const double size = std::max(norm, scale.rate), target = scale.target(options_.tolerance * size, floor);
  if (scale.unmoved(norm, target)) min_iterations = 0;
  for (int i = 0;; ++i) {
    report.iterations.push_back({norm, 0, MPI_Wtime() - started});
    report.converged = norm <= (i < min_iterations ? floor : target);
    report.failed = !(norm <= kDivergence * size) || (report.converged && !euler_.is_physical(q));
    if (report.converged || report.failed || i >= options_.max_iterations) break;
    pseudo_step(equation, q);
    norm = residual_norm(equation, q);
  }
  report.converged = report.converged && !report.failed;
  if (!report.converged)
    report.reason = fmt::format("dual time: the residual is {:.2g} of {:.2g} wanted after {} iterations", norm, target,
                                report.iterations.size() - 1);
  return report;
}

}  // namespace windhover::fluid
