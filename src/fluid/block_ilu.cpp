#include "fluid/block_ilu.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/petsc.h"
#include "fluid/five_columns.h"
// needs PETSc's types before it
#include <petsc/private/kernels/blockinvert.h>

namespace windhover::fluid {
namespace {

constexpr int kSize = kBlockSize, kEntries = kSize * kSize, kPadded = 8;

void store(const Column& c, float* p) { std::memcpy(p, &c, sizeof c); }

Column rounded(const double* column) {
  typedef double Wide __attribute__((vector_size(64)));
  Wide wide = {};
  std::memcpy(&wide, column, kSize * sizeof(double));
  return __builtin_convertvector(wide, Column);
}

Column load_five(const float* p) {
  Column c = {};
  std::memcpy(&c, p, kSize * sizeof(float));
  return c;
}

Padded load(const float* block) {
  Padded p;
  for (int k = 0; k < kSize; ++k) p.column[k] = load_column(block + kSize * k);
  return p;
}

/// factor · block
Padded product(const Padded& factor, const Padded& block) {
  Padded result;
  for (int k = 0; k < kSize; ++k) {
    float entries[kPadded];
    store(block.column[k], entries);
    result.column[k] = times(factor, entries);
  }
  return result;
}

/// False: has no inverse.
bool invert(const Padded& block, Padded& to) {
  double inverse[kEntries], work[kEntries];
  PetscInt pivots[kSize];
  PetscBool singular = PETSC_FALSE;
  for (int j = 0; j < kSize; ++j)
    for (int i = 0; i < kSize; ++i) inverse[kSize * j + i] = block.column[j][i];
  petsc(PetscKernel_A_gets_inverse_A_5(inverse, pivots, work, 0, PETSC_TRUE, &singular));
  for (int j = 0; j < kSize; ++j) to.column[j] = rounded(&inverse[kSize * j]);
  return !singular && std::all_of(inverse, inverse + kEntries, [](double x) { return std::isfinite(x); });
}

/// The fifth of five numbers times a factor.
Column with_last_times(const Column& c, float factor) { return c * Column{1, 1, 1, 1, factor, 1, 1, 1}; }

/// What to measure the fifth variable in, that it acts on the three before it as they on it: bytes hold numbers of one size.
float unit_of_last(std::span<const double* const> blocks) {
  constexpr int kLast = kSize - 1;
  double on_last = 0, by_last = 0;
  for (const double* b : blocks)
    for (int k = 1; k < kLast; ++k) {
      on_last += std::abs(b[kSize * k + kLast]);
      by_last += std::abs(b[kSize * kLast + k]);
    }
  const double unit = std::sqrt(on_last / by_last);
  return std::isfinite(unit) && unit > 0 ? static_cast<float>(unit) : 1;
}

/// Fill of a row while its pattern is found: a sorted chain of columns, each with its level.
class Chain {
 public:
  explicit Chain(int n) : next_(n + 1), level_(n, -1), end_(n) {}

  void begin() { next_[end_] = end_; }
  /// `after`: a column of the chain before this one, or end() for its head; returns the place of this one.
  int insert(int column, int level, int after) {
    if (level_[column] >= 0) {
      level_[column] = std::min(level_[column], level);
      return column;
    }
    while (next_[after] < column) after = next_[after];
    next_[column] = next_[after];
    next_[after] = column;
    level_[column] = level;
    return column;
  }
  int first() const { return next_[end_]; }
  int next(int column) const { return next_[column]; }
  int end() const { return end_; }
  int level(int column) const { return level_[column]; }
  void forget(int column) { level_[column] = -1; }

 private:
  std::vector<int> next_, level_;
  int end_;  ///< before the head and after the last
};

}  // namespace

void BlockIlu::Triangle::allocate() { block = std::make_unique<PackedBlock[]>(column.size()); }

BlockIlu::BlockIlu(int n, const int* start, const int* column, int levels, Rows given)
    : n_(n), rows_(given), given_start_(start, start + n + 1), given_column_(column, column + start[n]) {
  find_pattern(start, column, levels);
  lower_.allocate();
  upper_.allocate();
  pivot_.resize(static_cast<size_t>(n) * kEntries + kPadded);
  work_.resize(static_cast<size_t>(n) * kPadded);
}

void BlockIlu::find_pattern(const int* start, const int* column, int levels) {
  Chain chain(n_);
  std::vector<int> upper_level;
  for (int i = 0; i < n_; ++i) {
    chain.begin();
    int last = chain.end();
    for (int at = start[i]; at < start[i + 1]; ++at) last = chain.insert(column[at], 0, last);
    for (int k = chain.first(); k < i; k = chain.next(k)) {
      int after = k;
      for (size_t at = upper_.start[k]; at < upper_.start[k + 1]; ++at) {
        const int level = chain.level(k) + upper_level[at] + 1;
        if (level <= levels) after = chain.insert(upper_.column[at], level, after);
      }
    }
    for (int j = chain.first(); j != chain.end(); j = chain.next(j)) {
      if (j < i) lower_.column.push_back(j);
      if (j > i) {
        upper_.column.push_back(j);
        upper_level.push_back(chain.level(j));
      }
      chain.forget(j);
    }
    lower_.start.push_back(lower_.column.size());
    upper_.start.push_back(upper_.column.size());
  }
}

bool BlockIlu::factor(std::span<const double* const> blocks) {
  std::vector<Padded> row;         // of the pattern: lower part, diagonal, upper part
  std::vector<int> place(n_, -1);  // of a column in it
  bool regular = true;
  unit_ = unit_of_last(blocks);
  for (int i = 0; i < n_; ++i) {
    const size_t below = lower_.start[i], above = upper_.start[i];
    const int n_below = static_cast<int>(lower_.start[i + 1] - below),
              n_above = static_cast<int>(upper_.start[i + 1] - above);
    row.assign(n_below + 1 + n_above, {});
    for (int j = 0; j < n_below; ++j) place[lower_.column[below + j]] = j;
    place[i] = n_below;
    for (int j = 0; j < n_above; ++j) place[upper_.column[above + j]] = n_below + 1 + j;
    for (int at = given_start_[i]; at < given_start_[i + 1]; ++at)
      for (int c = 0; c < kSize; ++c)
        row[place[given_column_[at]]].column[c] =
            with_last_times(rounded(blocks[at] + kSize * c), 1 / unit_) * (c + 1 < kSize ? 1 : unit_);
    for (int j = 0; j < n_below; ++j) {
      const int k = lower_.column[below + j];
      lower_.block[below + j] = packed(product(row[j], load(&pivot_[size_t(k) * kEntries])));
      for (size_t at = upper_.start[k]; at < upper_.start[k + 1]; ++at) {
        const int to = place[upper_.column[at]];
        if (to < 0) continue;  // fill of a higher level
        const Padded update = product(row[j], unpacked(upper_.block[at]));
        for (int c = 0; c < kSize; ++c) row[to].column[c] -= update.column[c];
      }
    }
    Padded pivot;
    regular = invert(row[n_below], pivot) && regular;
    for (int c = 0; c < kSize; ++c) store(pivot.column[c], &pivot_[size_t(i) * kEntries + kSize * c]);
    for (int j = 0; j < n_above; ++j) upper_.block[above + j] = packed(product(pivot, row[n_below + 1 + j]));
    for (int j = 0; j < n_below; ++j) place[lower_.column[below + j]] = -1;
    place[i] = -1;
    for (int j = 0; j < n_above; ++j) place[upper_.column[above + j]] = -1;
  }
  return regular;
}

namespace {

constexpr int kAhead = 2048;  // bytes: rows are too short for the processor to see that one follows the other

/// The block, with memory so many bytes from it asked for.
template <int bytes>
const PackedBlock& ahead(const PackedBlock& block) {
  __builtin_prefetch(reinterpret_cast<const char*>(&block) + bytes);
  return block;
}

}  // namespace

void BlockIlu::solve(const float* b, float* x, const ChangedRows& changed) {
  const float over_unit = 1 / unit_;
  const auto substitute = [&](int i, const float* right) {
    Column sum = with_last_times(load_five(right), over_unit);
    for (size_t at = lower_.start[i]; at < lower_.start[i + 1]; ++at)
      sum -= times(ahead<kAhead>(lower_.block[at]), &work_[size_t(lower_.column[at]) * kPadded]);
    store(sum, &work_[size_t(i) * kPadded]);
  };
  int row = 0;
  const auto as_given = [&](int end) {
    for (; row < end; ++row) substitute(row, b + size_t(row - rows_.first) * kSize);
  };
  for (size_t k = 0; k < changed.rows.size(); ++k) {
    as_given(changed.rows[k]);
    substitute(row++, changed.values + k * kSize);
  }
  as_given(n_);
  // rows follow from the rows just done: what needs those comes last in each sum, and pivots wait for none
  const auto substitute_back = [&](int i) {
    float* y = &work_[size_t(i) * kPadded];
    Column sum = times(&pivot_[size_t(i) * kEntries], y);
    for (size_t at = upper_.start[i + 1]; at-- > upper_.start[i];)
      sum -= times(ahead<-kAhead>(upper_.block[at]), &work_[size_t(upper_.column[at]) * kPadded]);
    store(sum, y);
    return y;
  };
  int i = n_;
  while (i > rows_.first + rows_.count) substitute_back(--i);
  while (i > rows_.first) {
    const float* y = substitute_back(--i);
    float* to = x + size_t(i - rows_.first) * kSize;
    std::copy_n(y, kSize - 1, to);
    to[kSize - 1] = y[kSize - 1] * unit_;
  }
  while (i > 0) substitute_back(--i);
}

void BlockIlu::solve_row(int row, const float* b, float* x) const {
  float y[kPadded];
  store(with_last_times(load_five(b), 1 / unit_), y);
  store(with_last_times(times(&pivot_[size_t(row) * kEntries], y), unit_), y);
  std::copy_n(y, kSize, x);
}

}  // namespace windhover::fluid
