#include "fluid/interface_band.h"

#include <algorithm>

namespace windhover::fluid {
namespace {

constexpr int kFill = 1;    // levels: with 2 or 3 no Krylov iteration less
constexpr size_t kBlock = kVariables * kVariables;

template <class Number>
Number* five(Number* values, size_t cell) {
  return values + kVariables * cell;
}

}  // namespace

InterfaceBand::InterfaceBand(InterfaceCoupling& coupling, const BlockPattern& whole, int layers)
    : coupling_(coupling),
      cells_(coupling.cells_within(layers)),
      factors_([&] {
        const Pattern part = cut(whole);
        return BlockIlu(static_cast<int>(cells_.size()), part.start.data(), part.column.data(), kFill);
      }()),
      b_(kVariables * cells_.size()),
      x_(b_.size()) {
  for (const mesh::Index c : coupling.cells())
    at_interface_.push_back(static_cast<int>(std::lower_bound(cells_.begin(), cells_.end(), c) - cells_.begin()));
}

InterfaceBand::Pattern InterfaceBand::cut(const BlockPattern& whole) {
  std::vector<int> place(whole.rows(), -1);
  for (size_t i = 0; i < cells_.size(); ++i) place[cells_[i]] = static_cast<int>(i);
  Pattern part;
  for (const mesh::Index row : cells_) {
    for (int at = whole.start()[row]; at < whole.start()[row + 1]; ++at)
      if (const int column = place[whole.column()[at]]; column >= 0) {
        part.column.push_back(column);
        from_.push_back(at);
      }
    part.start.push_back(static_cast<int>(part.column.size()));
  }
  return part;
}

bool InterfaceBand::factor(const double* blocks) {
  std::vector<const double*> part;
  for (const int at : from_) part.push_back(blocks + kBlock * at);
  return factors_.factor(part);
}

/// changed = b − C x at the coupling's cells; at(i, to) writes the five of x.
template <class At>
void InterfaceBand::subtract_product(const float* b, const At& at, float* changed) {
  const std::vector<mesh::Index>& cells = coupling_.cells();
  for (size_t i = 0; i < cells.size(); ++i) std::copy_n(five(b, cells[i]), kVariables, five(changed, i));
  coupling_.subtract_product(at, changed);
}

/// x_ = B⁻¹ (1 − C D⁻¹) b
void InterfaceBand::solve(const float* b) {
  const std::vector<mesh::Index>& cells = coupling_.cells();
  changed_.resize(kVariables * cells.size());
  subtract_product(b, [&](size_t i, float* to) { factors_.solve_row(at_interface_[i], five(b, cells[i]), to); }, changed_.data());
  for (size_t i = 0; i < cells_.size(); ++i) std::copy_n(five(b, cells_[i]), kVariables, five(b_.data(), i));
  factors_.solve(b_.data(), x_.data(), {at_interface_, changed_.data()});
}

void InterfaceBand::solve(const float* b, float* x) {
  solve(b);
  for (size_t i = 0; i < cells_.size(); ++i) std::copy_n(five(x_.data(), i), kVariables, five(x, cells_[i]));
}

void InterfaceBand::right_side(const float* b, float* changed) {
  solve(b);
  subtract_product(b, [&](size_t i, float* to) { std::copy_n(five(x_.data(), at_interface_[i]), kVariables, to); }, changed);
}

}  // namespace windhover::fluid
