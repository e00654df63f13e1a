#include "fluid/preconditioner.h"

#include <optional>
#include <set>

#include "base/errors.h"
#include "fluid/block_ilu.h"
#include "fluid/rrk_smoother.h"

namespace windhover::fluid {
namespace {

/// Incomplete factors of this rank's own part of the matrix.
struct OwnIlu {
  int levels;
  std::optional<BlockIlu> factors;
};

OwnIlu& own_ilu(PC pc) {
  void* context = nullptr;
  petsc(PCShellGetContext(pc, &context));
  return *static_cast<OwnIlu*>(context);
}

PetscErrorCode factor_own(PC pc) {
  return CallbackGuard().run([pc] {
    OwnIlu& ilu = own_ilu(pc);
    Mat matrix = nullptr, inside = nullptr;
    petsc(PCGetOperators(pc, nullptr, &matrix));
    PetscBool parallel = PETSC_FALSE;
    petsc(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(matrix), MATMPIBAIJ, &parallel));
    if (parallel)
      petsc(MatMPIBAIJGetSeqBAIJ(matrix, &inside, nullptr, nullptr));
    else
      inside = matrix;
    if (!ilu.factors) {
      PetscInt n = 0;
      const PetscInt *start = nullptr, *column = nullptr;
      PetscBool done = PETSC_FALSE;
      petsc(MatGetRowIJ(inside, 0, PETSC_FALSE, PETSC_TRUE, &n, &start, &column, &done));
      ilu.factors.emplace(n, start, column, ilu.levels);
      petsc(MatRestoreRowIJ(inside, 0, PETSC_FALSE, PETSC_TRUE, &n, &start, &column, &done));
    }
    PetscScalar* blocks = nullptr;
    petsc(MatSeqBAIJGetArray(inside, &blocks));
    const bool regular = ilu.factors->factor(blocks);
    petsc(MatSeqBAIJRestoreArray(inside, &blocks));
    petsc(PCSetFailedReason(pc, regular ? PC_NOERROR : PC_FACTOR_NUMERIC_ZEROPIVOT));
  });
}

PetscErrorCode apply_own(PC pc, Vec b, Vec x) {
  return CallbackGuard().run([=] {
    const double* from = nullptr;
    double* to = nullptr;
    petsc(VecGetArrayRead(b, &from));
    petsc(VecGetArrayWrite(x, &to));
    own_ilu(pc).factors->solve(from, to);
    petsc(VecRestoreArrayWrite(x, &to));
    petsc(VecRestoreArrayRead(b, &from));
  });
}

PetscErrorCode destroy_own(PC pc) {
  return CallbackGuard().run([pc] { delete &own_ilu(pc); });
}

void set_up_ilu(PC pc, int levels, int) {
  petsc(PCSetType(pc, PCSHELL));
  petsc(PCShellSetName(pc, "block ILU in single precision"));
  petsc(PCShellSetContext(pc, new OwnIlu{levels, {}}));
  petsc(PCShellSetSetUp(pc, factor_own));
  petsc(PCShellSetApply(pc, apply_own));
  petsc(PCShellSetDestroy(pc, destroy_own));
}

/// Options of solvers inside the preconditioner, which exist only after the matrix is known. What the user says comes
/// first; what an earlier solver set here is not the user's word.
void set_defaults(PC pc, std::initializer_list<std::pair<std::string, std::string>> options) {
  static std::set<std::string> ours;
  const char* prefix = nullptr;
  petsc(PCGetOptionsPrefix(pc, &prefix));
  for (const auto& [name, value] : options) {
    const std::string option = fmt::format("-{}{}", prefix ? prefix : "", name);
    PetscBool has = PETSC_FALSE;
    petsc(PetscOptionsHasName(nullptr, nullptr, option.c_str(), &has));
    if (has && !ours.contains(option)) continue;
    ours.insert(option);
    petsc(PetscOptionsSetValue(nullptr, option.c_str(), value.c_str()));
  }
}

void set_up_asm(PC pc, int levels, int) {
  petsc(PCSetType(pc, PCASM));
  petsc(PCASMSetOverlap(pc, 1));
  set_defaults(pc, {{"sub_pc_type", "ilu"}, {"sub_pc_factor_levels", std::to_string(levels)}});
}

void set_up_rrk(PC pc, int, int) {
  register_rrk();
  petsc(PCSetType(pc, PCKSP));
  set_defaults(pc, {{"ksp_ksp_type", "rrk"}, {"ksp_ksp_max_it", "3"}, {"ksp_pc_type", "pbjacobi"}});
}

void set_up_rrk_multigrid(PC pc, int, int) {
  register_rrk();
  petsc(PCSetType(pc, PCGAMG));
  petsc(PCGAMGSetNSmooths(pc, 0));  // smoothed aggregation is for symmetric matrices
  petsc(PCGAMGSetReuseInterpolation(pc, PETSC_TRUE));
  set_defaults(pc,
               {{"mg_levels_ksp_type", "rrk"},
                {"mg_levels_ksp_max_it", "1"},
                {"mg_levels_pc_type", "bjacobi"},  // of ILU(0): blocks alone do not smooth cells as flat as a rotor's
                {"mg_coarse_ksp_type", "preonly"},
                {"mg_coarse_pc_type", "redundant"},
                {"mg_coarse_redundant_pc_type", "lu"},
                {"mg_coarse_redundant_pc_factor_mat_solver_type", "umfpack"}});
}

void set_up_point_block_jacobi(PC pc, int, int) { petsc(PCSetType(pc, PCPBJACOBI)); }

void set_up_lu(PC pc, int, int ranks) {
  if (ranks == 1) {
    petsc(PCSetType(pc, PCLU));
    petsc(PCFactorSetMatSolverType(pc, MATSOLVERUMFPACK));
    return;
  }
  petsc(PCSetType(pc, PCREDUNDANT));
  KSP inner = nullptr;
  petsc(PCRedundantGetKSP(pc, &inner));
  PC lu = nullptr;
  petsc(KSPGetPC(inner, &lu));
  petsc(PCSetType(lu, PCLU));
  petsc(PCFactorSetMatSolverType(lu, MATSOLVERUMFPACK));
}

void set_up_none(PC pc, int, int) { petsc(PCSetType(pc, PCNONE)); }

}  // namespace

const Preconditioner kPreconditioners[7] = {
    {"ilu", true, false, set_up_ilu},
    {"asm", true, false, set_up_asm},
    {"rrk", true, false, set_up_rrk},
    {"rrk-multigrid", true, true, set_up_rrk_multigrid},
    {"point_block_jacobi", true, false, set_up_point_block_jacobi},
    {"lu", true, true, set_up_lu},
    {"none", false, false, set_up_none},
};

const Preconditioner& preconditioner(const std::string& name) {
  std::string names;
  for (const Preconditioner& p : kPreconditioners) {
    if (name == p.name) return p;
    names += std::string(names.empty() ? "" : ", ") + p.name;
  }
  throw UserError("solver.preconditioner: '{}' is not one of {}", name, names);
}

}  // namespace windhover::fluid
