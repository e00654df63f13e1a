#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "fluid/aggregates.h"
#include "fluid/preconditioner.h"

using namespace windhover;
using namespace windhover::fluid;

namespace {

/// Four sides of a cell of an n x n grid, calls use(neighbour, direction): 0, 1 along x, 2, 3 along y; neighbour −1: a wall.
template <class Use>
void for_sides(int n, int row, Use&& use) {
  const int x = row % n, y = row / n;
  use(x > 0 ? row - 1 : -1, 0);
  use(x < n - 1 ? row + 1 : -1, 1);
  use(y > 0 ? row - n : -1, 2);
  use(y < n - 1 ? row + n : -1, 3);
}

/// An implicit step of two-dimensional acoustics (p, u, v; first-order upwind) on a walled square of n x n cells in which
/// sound travels an eighth of its side; two more variables that do not move.
MatHandle acoustic_step(int n) {
  MatHandle m;
  PetscInt own = PETSC_DECIDE, all = n * n;
  petsc(PetscSplitOwnership(PETSC_COMM_WORLD, &own, &all));
  petsc(MatCreateBAIJ(PETSC_COMM_WORLD, 5, 5 * own, 5 * own, PETSC_DETERMINE, PETSC_DETERMINE, 5, nullptr, 4, nullptr, m.out()));
  PetscInt first = 0, last = 0;
  petsc(MatGetOwnershipRange(m, &first, &last));
  const double cfl = n / 8.0;
  for (PetscInt row = first / 5; row < last / 5; ++row) {
    std::array<double, 25> diagonal{};
    for (int k = 0; k < 5; ++k) diagonal[6 * k] = 1;
    for_sides(n, row, [&](PetscInt j, int direction) {
      const int along = 1 + direction / 2;
      const double sign = direction % 2 ? 1 : -1;
      if (j < 0) {  // only pressure acts on a wall
        diagonal[5 * along] += cfl * sign;
        return;
      }
      std::array<double, 25> beyond{};
      for (const int k : {0, along}) {
        diagonal[6 * k] += 0.5 * cfl;
        beyond[6 * k] = -0.5 * cfl;
      }
      for (const auto& [a, b] : {std::pair{0, along}, {along, 0}}) {
        diagonal[5 * a + b] += 0.5 * cfl * sign;
        beyond[5 * a + b] = 0.5 * cfl * sign;
      }
      petsc(MatSetValuesBlocked(m, 1, &row, 1, &j, beyond.data(), INSERT_VALUES));
    });
    petsc(MatSetValuesBlocked(m, 1, &row, 1, &row, diagonal.data(), INSERT_VALUES));
  }
  petsc(MatAssemblyBegin(m, MAT_FINAL_ASSEMBLY));
  petsc(MatAssemblyEnd(m, MAT_FINAL_ASSEMBLY));
  return m;
}

/// Flexible GMRES iterations until the residual has fallen by 1e-6.
int iterations(const char* name, int n) {
  const MatHandle matrix = acoustic_step(n);
  VecHandle b, x;
  Handle<KSP, KSPDestroy> ksp;
  PC pc = nullptr;
  petsc(MatCreateVecs(matrix, x.out(), b.out()));
  PetscInt first = 0, last = 0, count = 0;
  petsc(VecGetOwnershipRange(b, &first, &last));
  for (PetscInt i = first; i < last; ++i) petsc(VecSetValue(b, i, std::sin(1.7 * i) + 0.3, INSERT_VALUES));
  petsc(VecAssemblyBegin(b));
  petsc(VecAssemblyEnd(b));
  petsc(KSPCreate(PETSC_COMM_WORLD, ksp.out()));
  petsc(KSPSetType(ksp, KSPFGMRES));
  petsc(KSPSetOperators(ksp, matrix, matrix));
  petsc(KSPSetTolerances(ksp, 1e-6, 0, PETSC_DEFAULT, 200));
  petsc(KSPGetPC(ksp, &pc));
  preconditioner(name).set_up(pc, 0, nullptr);
  petsc(KSPSolve(ksp, b, x));
  petsc(KSPGetIterationNumber(ksp, &count));
  return count;
}

}  // namespace

TEST_CASE("aggregates follow the strong coupling and take all nodes", "[multigrid]") {
  constexpr int n = 16;
  CouplingGraph graph;
  for (int row = 0; row < n * n; ++row) {
    for_sides(n, row, [&](int j, int direction) {
      if (j < 0) return;
      graph.neighbour.push_back(j);
      graph.strength.push_back(direction < 2 ? 1 : 100);
    });
    graph.start.push_back(static_cast<int>(graph.neighbour.size()));
  }
  const std::vector<int> group = aggregate(graph, 3);
  std::vector<int> size(n * n / 8, 0), column(n * n / 8, -1);
  for (int row = 0; row < n * n; ++row) {
    REQUIRE(group[row] >= 0);
    REQUIRE(group[row] < n * n / 8);
    ++size[group[row]];
    if (column[group[row]] < 0) column[group[row]] = row % n;
    CHECK(column[group[row]] == row % n);  // strong along y
  }
  for (const int s : size) CHECK(s == 8);
}

TEST_CASE("multigrid needs fewer iterations than incomplete factors, and few more on a finer grid", "[multigrid]") {
  const int coarse = iterations("rrk-multigrid", 20), fine = iterations("rrk-multigrid", 80);
  const int ilu_coarse = iterations("ilu", 20), ilu_fine = iterations("ilu", 80);
  CAPTURE(coarse, fine, ilu_coarse, ilu_fine);
  CHECK(fine <= 1.5 * coarse);
  CHECK(ilu_fine >= 1.5 * fine);
}
