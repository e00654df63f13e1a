#include "fluid/block_ilu_pc.h"

#include <optional>

#include "fluid/block_ilu.h"
#include "fluid/block_matrix.h"
#include "fluid/interface_band.h"

namespace windhover::fluid {
namespace {

/// Incomplete factors of this rank's own part of the matrix.
struct OwnIlu {
  int levels;
  InterfaceCoupling* coupling;
  std::optional<BlockIlu> factors;
  std::optional<InterfaceBand> band;
};

OwnIlu& own_ilu(PC pc) {
  void* context = nullptr;
  petsc(PCShellGetContext(pc, &context));
  return *static_cast<OwnIlu*>(context);
}

PetscErrorCode factor_own(PC pc) {
  return CallbackGuard().run([pc] {
    OwnIlu& ilu = own_ilu(pc);
    Mat matrix = nullptr;
    petsc(PCGetOperators(pc, nullptr, &matrix));
    const Mat inside = block_parts(matrix).inside;
    if (!ilu.factors) {
      const BlockPattern pattern(inside);
      ilu.factors.emplace(pattern.rows(), pattern.start(), pattern.column(), ilu.levels);
      if (ilu.coupling) ilu.band.emplace(*ilu.coupling, pattern);
    }
    PetscScalar* blocks = nullptr;
    petsc(MatSeqBAIJGetArray(inside, &blocks));
    const bool regular = ilu.factors->factor(blocks) && (!ilu.band || ilu.band->factor(blocks));
    petsc(MatSeqBAIJRestoreArray(inside, &blocks));
    petsc(PCSetFailedReason(pc, regular ? PC_NOERROR : PC_FACTOR_NUMERIC_ZEROPIVOT));
  });
}

PetscErrorCode apply_own(PC pc, Vec b, Vec x) {
  return CallbackGuard().run([=] {
    OwnIlu& ilu = own_ilu(pc);
    const double* from = nullptr;
    double* to = nullptr;
    petsc(VecGetArrayRead(b, &from));
    petsc(VecGetArrayWrite(x, &to));
    ilu.factors->solve(from, to, ilu.band ? ilu.band->right_side(from) : ChangedRows{});
    petsc(VecRestoreArrayWrite(x, &to));
    petsc(VecRestoreArrayRead(b, &from));
  });
}

PetscErrorCode destroy_own(PC pc) {
  return CallbackGuard().run([pc] { delete &own_ilu(pc); });
}

}  // namespace

void set_up_block_ilu(PC pc, int levels, InterfaceCoupling* coupling) {
  petsc(PCSetType(pc, PCSHELL));
  petsc(PCShellSetName(pc, "block ILU in bfloat16"));
  petsc(PCShellSetContext(pc, new OwnIlu{levels, coupling, {}, {}}));
  petsc(PCShellSetSetUp(pc, factor_own));
  petsc(PCShellSetApply(pc, apply_own));
  petsc(PCShellSetDestroy(pc, destroy_own));
}

void set_up_everywhere_lu(PC pc) {
  MPI_Comm comm = PetscObjectComm(reinterpret_cast<PetscObject>(pc));
  int ranks = 1;
  MPI_Comm_size(comm, &ranks);
  PC lu = pc;
  if (ranks > 1) {
    KSP inner = nullptr;
    petsc(PCSetType(pc, PCREDUNDANT));
    petsc(PCRedundantGetKSP(pc, &inner));
    petsc(KSPGetPC(inner, &lu));
  }
  petsc(PCSetType(lu, PCLU));
  petsc(PCFactorSetMatSolverType(lu, MATSOLVERUMFPACK));
}

}  // namespace windhover::fluid
