#include <catch2/catch.hpp>
#include <cmath>

#include "base/collective.h"
#include "fluid/single_gmres.h"
#include "fluid/single_vector.h"

using namespace windhover;
using namespace windhover::fluid;

namespace {

/// The same numbers as floats and as PETSc's doubles; an odd number on each rank, more than a block of sums.
struct Pair {
  static constexpr PetscInt kSize = 2777;
  VecHandle single, twice;

  explicit Pair(double frequency)
      : single(make_single_vector(PETSC_COMM_WORLD, kSize)) {
    petsc(VecCreateMPI(PETSC_COMM_WORLD, kSize, PETSC_DETERMINE, twice.out()));
    double* to = nullptr;
    petsc(VecGetArray(twice, &to));
    for (PetscInt i = 0; i < kSize; ++i)
      to[i] = single_values(single)[i] = static_cast<float>(std::sin(frequency * (i + 1) + rank_of(PETSC_COMM_WORLD)));
    petsc(VecRestoreArray(twice, &to));
  }
  /// ‖single − twice‖ / ‖twice‖
  double difference() const {
    double sums[2] = {};
    const double* exact = nullptr;
    petsc(VecGetArrayRead(twice, &exact));
    for (PetscInt i = 0; i < kSize; ++i) {
      sums[0] += std::pow(single_values_read(single)[i] - exact[i], 2);
      sums[1] += exact[i] * exact[i];
    }
    petsc(VecRestoreArrayRead(twice, &exact));
    MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
    return std::sqrt(sums[0] / sums[1]);
  }
};

}  // namespace

TEST_CASE("Vectors of floats do what GMRES asks of vectors") {
  constexpr double kRounding = 1e-6;
  const Pair x(0.7), y(1.3), z(0.2);
  VecHandle copy;
  petsc(VecDuplicate(x.single, copy.out()));
  const Vec singles[] = {y.single, z.single, x.single}, doubles[] = {y.twice, z.twice, x.twice};
  double products[3], exact[3], norm = 0, exact_norm = 0;
  petsc(VecMDot(x.single, 3, singles, products));
  petsc(VecMDot(x.twice, 3, doubles, exact));
  petsc(VecNorm(x.single, NORM_2, &norm));
  petsc(VecNorm(x.twice, NORM_2, &exact_norm));
  for (int k = 0; k < 3; ++k) CHECK(products[k] == Approx(exact[k]).margin(kRounding * exact_norm * exact_norm));
  CHECK(norm == Approx(exact_norm).epsilon(kRounding));
  petsc(VecDot(y.single, x.single, products));
  CHECK(products[0] == Approx(exact[0]).margin(kRounding * exact_norm * exact_norm));

  const double factors[] = {0.3, -1.7};
  for (const auto& [a, b, c] : {std::array<Vec, 3>{x.single, y.single, z.single}, {x.twice, y.twice, z.twice}}) {
    Vec added[] = {b, c};
    petsc(VecMAXPY(a, 2, factors, added));
    petsc(VecScale(a, 1.1));
    petsc(VecAYPX(b, -0.4, a));
    petsc(VecAXPY(b, 0.6, c));
    petsc(VecWAXPY(c, 2.5, a, b));
  }
  for (const Pair* p : {&x, &y, &z}) CHECK(p->difference() < kRounding);

  petsc(VecCopy(x.single, copy));
  petsc(VecAXPY(copy, -1, x.single));
  petsc(VecNorm(copy, NORM_2, &norm));
  CHECK(norm == 0);
  petsc(VecSet(x.single, 0));
  petsc(VecNorm(x.single, NORM_2, &norm));
  CHECK(norm == 0);
}

TEST_CASE("Vectors of floats refuse what would take two floats for a double") {
  const Pair x(0.7);
  double value = 0;
  petsc(PetscPushErrorHandler(PetscReturnErrorHandler, nullptr));
  CHECK(VecMax(x.single, nullptr, &value) != 0);
  CHECK(VecNorm(x.single, NORM_1, &value) != 0);
  CHECK(VecSet(x.single, 1) != 0);
  petsc(PetscPopErrorHandler());
}

TEST_CASE("Flexible GMRES of floats solves to the digits that floats have") {
  // each rank's rows of a tridiagonal matrix, coupled with the next rank's through a sum over all
  constexpr PetscInt kSize = 501;
  const auto multiply = [](Vec x, Vec y) {
    const float* from = single_values_read(x);
    float* to = single_values(y);
    double sum = 0;
    for (PetscInt i = 0; i < kSize; ++i) sum += from[i];
    MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
    for (PetscInt i = 0; i < kSize; ++i)
      to[i] = static_cast<float>((2 + std::sin(3.0 * i)) * from[i] - (i > 0 ? 0.6 * from[i - 1] : 0) + 1e-3 * sum);
  };
  const auto precondition = [](Vec x, Vec y) {
    for (PetscInt i = 0; i < kSize; ++i)
      single_values(y)[i] = static_cast<float>(single_values_read(x)[i] / (2 + std::sin(3.0 * i)));
  };
  SingleGmres gmres(PETSC_COMM_WORLD, kSize, multiply, precondition);
  const double fall = GENERATE(1e-2, 1e-5);
  for (PetscInt i = 0; i < kSize; ++i) single_values(gmres.right_side())[i] = static_cast<float>(std::cos(1.7 * i * i));
  petsc(KSPSetTolerances(gmres.ksp(), fall, 0, PETSC_DEFAULT, 100));
  petsc(KSPSolve(gmres.ksp(), gmres.right_side(), gmres.solution()));
  gmres.rethrow();
  KSPConvergedReason reason;
  petsc(KSPGetConvergedReason(gmres.ksp(), &reason));
  CHECK(reason == KSP_CONVERGED_RTOL);
  VecHandle residual;
  double left = 0, all = 0;
  petsc(VecDuplicate(gmres.solution(), residual.out()));
  multiply(gmres.solution(), residual);
  petsc(VecAYPX(residual, -1, gmres.right_side()));
  petsc(VecNorm(residual, NORM_2, &left));
  petsc(VecNorm(gmres.right_side(), NORM_2, &all));
  CHECK(left < 1.01 * fall * all);
  CHECK(left > 1e-3 * fall * all);
}
