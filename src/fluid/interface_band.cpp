#include "fluid/interface_band.h"

#include <algorithm>

namespace windhover::fluid {
namespace {

constexpr int kLayers = 3;  // of cells beside an interface's own
constexpr int kFill = 1;    // levels: with 2 or 3 no Krylov iteration less
constexpr size_t kBlock = kVariables * kVariables;

template <class Number>
Number* five(Number* values, size_t cell) {
  return values + kVariables * cell;
}

std::vector<int> places(const std::vector<mesh::Index>& cells, mesh::Index n) {
  std::vector<int> place(n, -1);
  for (size_t i = 0; i < cells.size(); ++i) place[cells[i]] = static_cast<int>(i);
  return place;
}

}  // namespace

InterfaceBand::InterfaceBand(InterfaceCoupling& coupling, const BlockPattern& whole)
    : coupling_(coupling),
      cells_(coupling.cells_within(kLayers)),
      place_(places(cells_, whole.rows())),
      factors_([&] {
        const Pattern part = cut(whole);
        return BlockIlu(static_cast<int>(cells_.size()), part.start.data(), part.column.data(), kFill);
      }()),
      sum_(kVariables * place_.size()),
      b_(kVariables * cells_.size()),
      x_(b_.size()) {}

InterfaceBand::Pattern InterfaceBand::cut(const BlockPattern& whole) {
  Pattern part;
  for (const mesh::Index row : cells_) {
    for (int at = whole.start()[row]; at < whole.start()[row + 1]; ++at)
      if (const int column = place_[whole.column()[at]]; column >= 0) {
        part.column.push_back(column);
        from_.push_back(at);
      }
    part.start.push_back(static_cast<int>(part.column.size()));
  }
  return part;
}

bool InterfaceBand::factor(const double* blocks) {
  std::vector<double> part(kBlock * from_.size());
  for (size_t i = 0; i < from_.size(); ++i) std::copy_n(blocks + kBlock * from_[i], kBlock, &part[kBlock * i]);
  return factors_.factor(part.data());
}

const double* InterfaceBand::right_side(const double* b) {
  double* sum = sum_.data();
  std::copy_n(b, sum_.size(), sum);
  coupling_.subtract_product([&](mesh::Index c, float* to) { factors_.solve_row(place_[c], five(b, c), to); }, sum);
  for (size_t i = 0; i < cells_.size(); ++i) std::copy_n(five(sum, cells_[i]), kVariables, five(b_.data(), i));
  factors_.solve(b_.data(), x_.data());
  for (const mesh::Index c : cells_) std::copy_n(five(b, c), kVariables, five(sum, c));
  coupling_.subtract_product([&](mesh::Index c, float* to) { std::copy_n(five(x_.data(), place_[c]), kVariables, to); }, sum);
  return sum;
}

}  // namespace windhover::fluid
