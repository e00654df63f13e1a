#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <random>
#include <set>

#include "base/petsc.h"
#include "fluid/block_ilu.h"
#include "fluid/block_ilu_pc.h"

using windhover::MatHandle;
using windhover::petsc;
using windhover::VecHandle;
using windhover::fluid::BlockIlu;
using windhover::fluid::set_up_block_ilu;

namespace {

constexpr int kRows = 60;

/// Blocks on a random symmetric pattern, by columns; diagonals rule, as in an implicit step.
struct RandomMatrix {
  std::vector<int> start{0}, column;
  std::vector<double> blocks;

  explicit RandomMatrix(unsigned seed, int pairs = 2) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<> uniform(-1, 1);
    std::vector<std::vector<bool>> there(kRows, std::vector<bool>(kRows, false));
    for (int i = 0; i < kRows; ++i) {
      there[i][i] = true;
      for (int k = 0; k < pairs; ++k) {
        const int j = static_cast<int>(random() % kRows);
        there[i][j] = there[j][i] = true;
      }
    }
    for (int i = 0; i < kRows; ++i) {
      for (int j = 0; j < kRows; ++j) {
        if (!there[i][j]) continue;
        column.push_back(j);
        for (int k = 0; k < 25; ++k) blocks.push_back(uniform(random) + (i == j && k % 6 == 0 ? 8 : 0));
      }
      start.push_back(static_cast<int>(column.size()));
    }
  }

  std::vector<const double*> places() const {
    std::vector<const double*> places;
    for (size_t k = 0; k < column.size(); ++k) places.push_back(&blocks[25 * k]);
    return places;
  }

  /// Of all ranks, if there are more.
  MatHandle petsc_matrix(MPI_Comm comm = PETSC_COMM_SELF) const {
    MatHandle m;
    petsc(MatCreateBAIJ(comm, 5, PETSC_DECIDE, PETSC_DECIDE, 5 * kRows, 5 * kRows, 20, nullptr, 20, nullptr, m.out()));
    petsc(MatSetOption(m, MAT_ROW_ORIENTED, PETSC_FALSE));
    PetscInt first = 0, end = 0;
    petsc(MatGetOwnershipRange(m, &first, &end));
    for (int i = first / 5; i < end / 5; ++i)
      petsc(MatSetValuesBlocked(m, 1, &i, start[i + 1] - start[i], &column[start[i]], &blocks[25 * start[i]],
                                INSERT_VALUES));
    petsc(MatAssemblyBegin(m, MAT_FINAL_ASSEMBLY));
    petsc(MatAssemblyEnd(m, MAT_FINAL_ASSEMBLY));
    return m;
  }
};

/// What PETSc's factors, in double precision, make of b.
std::vector<double> petsc_solution(const RandomMatrix& matrix, const char* type, int levels,
                                   const std::vector<double>& b) {
  const MatHandle m = matrix.petsc_matrix();
  VecHandle from, to;
  std::vector<double> x(b.size());
  petsc(VecCreateSeqWithArray(PETSC_COMM_SELF, 5, static_cast<int>(b.size()), b.data(), from.out()));
  petsc(VecCreateSeqWithArray(PETSC_COMM_SELF, 5, static_cast<int>(x.size()), x.data(), to.out()));
  PC pc = nullptr;
  petsc(PCCreate(PETSC_COMM_SELF, &pc));
  petsc(PCSetOperators(pc, m, m));
  petsc(PCSetType(pc, type));
  petsc(PCFactorSetMatOrderingType(pc, MATORDERINGNATURAL));
  if (std::string(type) == PCILU) petsc(PCFactorSetLevels(pc, levels));
  petsc(PCApply(pc, from, to));
  petsc(PCDestroy(&pc));
  return x;
}

double difference(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0, norm = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]), norm += b[i] * b[i];
  return std::sqrt(sum / norm);
}

std::vector<float> rounded(const std::vector<double>& b) { return {b.begin(), b.end()}; }

std::vector<double> solution(BlockIlu& ilu, const std::vector<double>& b, const windhover::fluid::ChangedRows& changed = {}) {
  std::vector<float> x(b.size());
  ilu.solve(rounded(b).data(), x.data(), changed);
  return {x.begin(), x.end()};
}

}  // namespace

TEST_CASE("Incomplete factors are PETSc's, to the digits of bytes") {
  constexpr double kRounding = 1.0 / 512;
  const RandomMatrix matrix(3);
  std::vector<double> b(5 * kRows);
  for (size_t i = 0; i < b.size(); ++i) b[i] = std::sin(1.0 + double(i));
  std::vector<std::vector<double>> solutions;
  for (const int levels : {0, 1, 2}) {
    BlockIlu ilu(kRows, matrix.start.data(), matrix.column.data(), levels);
    REQUIRE(ilu.factor(matrix.places()));
    solutions.push_back(solution(ilu, b));
    CHECK(difference(solutions.back(), petsc_solution(matrix, PCILU, levels, b)) < kRounding);
  }
  CHECK(difference(solutions[0], solutions[1]) > 5 * kRounding);  // fill makes a difference here
  CHECK(difference(solutions[1], solutions[2]) > 5 * kRounding);
  BlockIlu whole(kRows, matrix.start.data(), matrix.column.data(), kRows);
  REQUIRE(whole.factor(matrix.places()));
  CHECK(difference(solution(whole, b), petsc_solution(matrix, PCLU, 0, b)) < kRounding);
}

TEST_CASE("Rows of the right side can be changed") {
  const RandomMatrix matrix(5);
  BlockIlu ilu(kRows, matrix.start.data(), matrix.column.data(), 1);
  REQUIRE(ilu.factor(matrix.places()));
  std::vector<double> b(5 * kRows), values;
  for (size_t i = 0; i < b.size(); ++i) b[i] = std::sin(1.0 + double(i));
  const std::vector<int> rows = {0, 3, 4, kRows - 1};
  std::vector<double> changed = b;
  for (const int row : rows)
    for (int k = 0; k < 5; ++k) values.push_back(changed[5 * row + k] = std::cos(double(row + k)));
  CHECK(solution(ilu, b, {rows, rounded(values).data()}) == solution(ilu, changed));
}

TEST_CASE("Each rank solves its own rows with one layer of the others' around them") {
  const int pairs = GENERATE(2, 0);  // 0: nothing is coupled
  const RandomMatrix random(6, pairs);
  const MatHandle matrix = random.petsc_matrix(PETSC_COMM_WORLD);
  PetscInt first = 0, end = 0;
  petsc(MatGetOwnershipRange(matrix, &first, &end));
  std::set<int> own, rows;
  for (int i = first / 5; i < end / 5; ++i) own.insert(i);
  for (const int i : own) rows.insert(&random.column[random.start[i]], &random.column[random.start[i + 1]]);
  // the same system with dense blocks
  const std::vector<int> order(rows.begin(), rows.end());
  const auto n = static_cast<Eigen::Index>(order.size());
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(5 * n, 5 * n);
  Eigen::VectorXd right(5 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (int k = 0; k < 5; ++k) right[5 * i + k] = std::sin(1.0 + 5 * order[i] + k);
    for (int at = random.start[order[i]]; at < random.start[order[i] + 1]; ++at)
      if (const auto found = std::find(order.begin(), order.end(), random.column[at]); found != order.end())
        dense.block<5, 5>(5 * i, 5 * (found - order.begin())) =
            Eigen::Matrix<double, 5, 5>::Map(&random.blocks[25 * at]);
  }
  const Eigen::VectorXd solution = dense.lu().solve(right);
  std::vector<double> expected, found(end - first);
  for (Eigen::Index i = 0; i < n; ++i)
    if (own.contains(order[i])) expected.insert(expected.end(), &solution[5 * i], &solution[5 * i] + 5);

  VecHandle b, x;
  petsc(MatCreateVecs(matrix, b.out(), x.out()));
  for (PetscInt k = first; k < end; ++k) petsc(VecSetValue(b, k, std::sin(1.0 + k), INSERT_VALUES));
  petsc(VecAssemblyBegin(b));
  petsc(VecAssemblyEnd(b));
  PC pc = nullptr;
  petsc(PCCreate(PETSC_COMM_WORLD, &pc));
  petsc(PCSetOperators(pc, matrix, matrix));
  set_up_block_ilu(pc, kRows, nullptr);
  for (int turn = 0; turn < 2; ++turn) {
    petsc(PCApply(pc, b, x));
    const double* values = nullptr;
    petsc(VecGetArrayRead(x, &values));
    found.assign(values, values + (end - first));
    petsc(VecRestoreArrayRead(x, &values));
    CHECK(difference(found, expected) < 1.0 / 512);
    // other ranks' rows are fetched anew with the matrix
    petsc(MatScale(matrix, 0.5));
    petsc(PCSetOperators(pc, matrix, matrix));
    for (double& value : expected) value *= 2;
  }
  petsc(PCDestroy(&pc));
}

TEST_CASE("Factors can be made again, and tell of a block that has no inverse") {
  RandomMatrix matrix(4);
  BlockIlu ilu(kRows, matrix.start.data(), matrix.column.data(), 1);
  REQUIRE(ilu.factor(matrix.places()));
  const std::vector<double> b(5 * kRows, 1.0), first = solution(ilu, b);
  for (double& value : matrix.blocks) value *= 2;
  REQUIRE(ilu.factor(matrix.places()));
  std::vector<double> second = solution(ilu, b);
  for (double& value : second) value *= 2;
  CHECK(difference(second, first) < 1e-6);
  for (int k = 0; k < 25; ++k) matrix.blocks[k] = 0;
  CHECK_FALSE(ilu.factor(matrix.places()));
}
