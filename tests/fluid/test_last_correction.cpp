#include <catch2/catch.hpp>
#include <cmath>
#include <optional>

#include "fluid/last_correction.h"

using namespace windhover;
using namespace windhover::fluid;

namespace {

/// Upwinded advection and diffusion in one dimension with a coefficient that varies.
MatHandle advection(int n) {
  MatHandle m;
  petsc(MatCreateAIJ(PETSC_COMM_WORLD, PETSC_DECIDE, PETSC_DECIDE, n, n, 3, nullptr, 2, nullptr, m.out()));
  PetscInt first = 0, last = 0;
  petsc(MatGetOwnershipRange(m, &first, &last));
  for (PetscInt i = first; i < last; ++i) {
    petsc(MatSetValue(m, i, i, 2 + std::sin(3.0 * i), INSERT_VALUES));
    if (i > 0) petsc(MatSetValue(m, i, i - 1, -0.4, INSERT_VALUES));
    if (i + 1 < n) petsc(MatSetValue(m, i, i + 1, -0.1, INSERT_VALUES));
  }
  petsc(MatAssemblyBegin(m, MAT_FINAL_ASSEMBLY));
  petsc(MatAssemblyEnd(m, MAT_FINAL_ASSEMBLY));
  return m;
}

/// Flexible GMRES (or `type`) over point Jacobi whose products tell of themselves.
struct Solver {
  MatHandle matrix = advection(200), product;
  VecHandle b, x;
  KspHandle ksp;
  std::optional<LastCorrection> last;

  Solver(KSPType type, double fall, bool may_end_early) {
    PetscInt own = 0;
    petsc(MatCreateVecs(matrix, x.out(), b.out()));
    petsc(VecGetLocalSize(b, &own));
    petsc(MatCreateShell(PETSC_COMM_WORLD, own, own, PETSC_DETERMINE, PETSC_DETERMINE, this, product.out()));
    petsc(MatShellSetOperation(product, MATOP_MULT, reinterpret_cast<void (*)()>(multiply)));
    petsc(KSPCreate(PETSC_COMM_WORLD, ksp.out()));
    petsc(KSPSetType(ksp, type));
    petsc(KSPSetOperators(ksp, product, matrix));
    PC pc = nullptr;
    petsc(KSPGetPC(ksp, &pc));
    petsc(PCSetType(pc, PCJACOBI));
    petsc(KSPSetTolerances(ksp, fall, 0, PETSC_DEFAULT, 100));
    if (may_end_early) last.emplace(ksp);
    PetscInt first = 0, end = 0;
    petsc(VecGetOwnershipRange(b, &first, &end));
    for (PetscInt i = first; i < end; ++i) petsc(VecSetValue(b, i, std::cos(1.7 * i * i), INSERT_VALUES));
    petsc(VecAssemblyBegin(b));
    petsc(VecAssemblyEnd(b));
  }
  static PetscErrorCode multiply(Mat m, Vec x, Vec y) {
    void* context = nullptr;
    petsc(MatShellGetContext(m, &context));
    auto& self = *static_cast<Solver*>(context);
    if (self.last) self.last->note_product(y);
    return MatMult(self.matrix, x, y);
  }
  int solve() {
    PetscInt iterations = 0;
    petsc(KSPSolve(ksp, b, x));
    petsc(KSPGetIterationNumber(ksp, &iterations));
    return static_cast<int>(iterations);
  }
  /// b − A x
  VecHandle residual() const {
    VecHandle r;
    petsc(VecDuplicate(b, r.out()));
    petsc(MatMult(matrix, x, r));
    petsc(VecAYPX(r, -1, b));
    return r;
  }
};

double norm(Vec v) {
  double result = 0;
  petsc(VecNorm(v, NORM_2, &result));
  return result;
}

}  // namespace

TEST_CASE("a linear solve may end with the preconditioner alone where that is expected to do", "[krylov]") {
  constexpr double kFall = 0.01;
  Solver whole(KSPFGMRES, kFall, false), shorter(KSPFGMRES, kFall, true);
  const int iterations = whole.solve(), fewer = shorter.solve();
  CAPTURE(iterations, fewer);
  CHECK(fewer == iterations - 1);

  VecHandle expected;
  petsc(VecDuplicate(shorter.x, expected.out()));
  PC pc = nullptr;
  petsc(KSPGetPC(shorter.ksp, &pc));
  petsc(PCApply(pc, shorter.residual(), expected));
  petsc(VecAXPY(expected, 1, shorter.x));
  CHECK(norm(shorter.residual()) > kFall * norm(shorter.b));
  shorter.last->apply(shorter.ksp, shorter.b, shorter.x);
  petsc(VecAXPY(expected, -1, shorter.x));
  CHECK(norm(expected) < 1e-12 * norm(shorter.x));
  CHECK(norm(shorter.residual()) < kFall * norm(shorter.b));
}

TEST_CASE("a linear solve whose preconditioner multiplies with its matrix does not end early", "[krylov]") {
  const double fall = GENERATE(1e-2, 1e-3, 1e-4, 1e-5, 1e-6);
  CAPTURE(fall);
  Solver s(KSPFGMRES, fall, true), reference(KSPFGMRES, fall, false);
  for (const Solver* each : {&s, &reference}) {
    PC pc = nullptr;
    KSP inner = nullptr;
    petsc(KSPGetPC(each->ksp, &pc));
    petsc(PCSetType(pc, PCKSP));
    petsc(PCSetUseAmat(pc, PETSC_TRUE));
    petsc(PCKSPGetKSP(pc, &inner));
    petsc(KSPSetType(inner, KSPRICHARDSON));
    petsc(KSPRichardsonSetScale(inner, 0.3));
    petsc(KSPSetTolerances(inner, 0, 0, PETSC_DEFAULT, 2));
  }
  CHECK(s.solve() == reference.solve());
  const double before = norm(s.residual());
  s.last->apply(s.ksp, s.b, s.x);
  CHECK(norm(s.residual()) == before);
}

TEST_CASE("only flexible GMRES that has not been restarted ends with the preconditioner alone", "[krylov]") {
  const bool flexible = GENERATE(false, true);
  const double fall = GENERATE(1e-4, 1e-5, 1e-6, 1e-7);
  CAPTURE(flexible, fall);
  const char* type = flexible ? KSPFGMRES : KSPGMRES;
  Solver s(type, fall, true), reference(type, fall, false);
  if (flexible)
    for (const Solver* each : {&s, &reference}) petsc(KSPGMRESSetRestart(each->ksp, 3));
  CHECK(s.solve() == reference.solve());
  const double before = norm(s.residual());
  s.last->apply(s.ksp, s.b, s.x);
  CHECK(norm(s.residual()) == before);
}
