// Interface quasi-Newton with the inverse Jacobian from least squares (Degroote, Bathe & Vierendeels, Comput. Struct. 87,
// 2009), columns filtered by QR (Haelterman et al., Comput. Struct. 171, 2016), those of earlier steps used again.
#include <algorithm>
#include <deque>

#include "coupling/scheme.h"

namespace windhover::coupling {
namespace {

/// Two evaluations' difference: of the residual G(x) - x, and of G(x).
struct Column {
  VectorXd residual, answer;
};

class IqnIls : public Scheme {
 public:
  IqnIls(const CouplingOptions& options, int size) : options_(options), size_(size) {}

  void solve(VectorXd x, FixedPoint& fixed_point) override {
    current_.clear();
    std::optional<Column> last;
    while (const auto g = fixed_point.evaluate(x, options_.relaxation)) {
      const Column now{*g - x, *g};
      if (fixed_point.flow_converged()) {  // before that, differences tell of Newton's progress more than of the loads
        if (last) keep({now.residual - last->residual, now.answer - last->answer}, fixed_point);
        last = now;
      }
      x += step(now.residual, fixed_point.scale());
    }
  }

  void accept() override {
    kept_.push_front(std::move(current_));
    current_.clear();
    while (static_cast<int>(kept_.size()) > options_.reuse_steps) kept_.pop_back();
  }
  void reject() override {
    current_.clear();
    kept_.clear();  // of another step size
  }

  /// Number of columns of each step, then the columns.
  std::vector<double> state() const override {
    std::vector<double> all = {double(kept_.size())};
    for (const auto& columns : kept_) {
      all.push_back(double(columns.size()));
      for (const Column& c : columns) {
        all.insert(all.end(), c.residual.begin(), c.residual.end());
        all.insert(all.end(), c.answer.begin(), c.answer.end());
      }
    }
    return all;
  }
  void restore(std::span<const double> all) override {
    size_t at = 0;
    const auto vector = [&] {
      at += size_;
      return VectorXd(VectorXd::Map(&all[at - size_], size_));
    };
    kept_.assign(static_cast<size_t>(all[at++]), {});
    for (auto& columns : kept_)
      for (auto left = static_cast<long>(all[at++]); left > 0; --left) {
        Column c;
        c.residual = vector();
        c.answer = vector();
        columns.push_back(std::move(c));
      }
  }

 private:
  void keep(Column column, const FixedPoint& fixed_point) {
    const VectorXd change = column.residual.cwiseQuotient(fixed_point.scale());
    if (change.lpNorm<Eigen::Infinity>() > fixed_point.tolerance()) current_.push_front(std::move(column));
    if (static_cast<int>(current_.size()) > options_.columns) current_.pop_back();
  }

  /// The change of x: what the columns say, and the relaxed residual where they say nothing.
  VectorXd step(const VectorXd& residual, const VectorXd& scale) const {
    std::vector<VectorXd> basis;  // orthonormal, scaled
    std::vector<const Column*> used;
    std::vector<VectorXd> triangle;  // of the used columns: what each has of the basis
    const auto consider = [&](const std::deque<Column>& columns) {
      for (const Column& c : columns) {
        if (static_cast<int>(used.size()) == options_.columns) return;
        VectorXd v = c.residual.cwiseQuotient(scale), parts(used.size() + 1);
        const double whole = v.norm();
        for (size_t i = 0; i < basis.size(); ++i) {
          parts[i] = basis[i].dot(v);
          v -= parts[i] * basis[i];
        }
        parts[used.size()] = v.norm();
        if (!(v.norm() > options_.filter * whole)) continue;
        basis.push_back(v.normalized());
        used.push_back(&c);
        triangle.push_back(std::move(parts));
      }
    };
    consider(current_);
    for (const auto& columns : kept_) consider(columns);

    VectorXd rest = residual.cwiseQuotient(scale), wanted(basis.size());
    for (size_t i = 0; i < basis.size(); ++i) {
      wanted[i] = -basis[i].dot(rest);
      rest += wanted[i] * basis[i];
    }
    VectorXd change = options_.relaxation * rest.cwiseProduct(scale);
    for (size_t j = used.size(); j-- > 0;) {
      const double weight = wanted[j] / triangle[j][j];
      for (size_t i = 0; i < j; ++i) wanted[i] -= weight * triangle[j][i];
      change += weight * (used[j]->answer - used[j]->residual);
    }
    return change;
  }

  CouplingOptions options_;
  int size_;
  std::deque<Column> current_;           ///< of this step, newest first
  std::deque<std::deque<Column>> kept_;  ///< of accepted steps, newest first
};

}  // namespace

std::unique_ptr<Scheme> make_iqn_ils(const CouplingOptions& options, int size, int) {
  return std::make_unique<IqnIls>(options, size);
}

}  // namespace windhover::coupling
