#include "fluid/multigrid.h"

#include <string>

#include "fluid/block_ilu_pc.h"
#include "fluid/rrk_smoother.h"

namespace windhover::fluid {
namespace {

constexpr PetscInt kCoarsest = 1000;   // rows, on all ranks, that UMFPACK takes over
constexpr double kLeastGain = 0.7;     // of rows from level to level; more are left where ranks hold few cells each

PetscInt rows(Mat matrix) {
  PetscInt n = 0;
  petsc(MatGetSize(matrix, &n, nullptr));
  return n;
}

}  // namespace

Multigrid::Multigrid(Mat product, Mat matrix, int ilu_levels, InterfaceCoupling* coupling, const char* options_prefix) {
  register_rrk();
  levels_.push_back({matrix, {}, {}, {}});
  while (rows(levels_.back().matrix) > kCoarsest) {
    const Mat fine = levels_.back().matrix;
    auto next = std::make_unique<Coarsening>(fine);
    if (rows(next->matrix()) > kLeastGain * rows(fine)) break;
    levels_.push_back({next->matrix(), {}, {}, {}});
    petsc(MatCreateVecs(next->matrix(), levels_.back().x.out(), levels_.back().b.out()));
    coarsening_.push_back(std::move(next));
  }
  petsc(MatConvert(levels_.back().matrix, MATAIJ, MAT_INITIAL_MATRIX, coarsest_.out()));
  for (Level& level : levels_) {
    const bool finest = level.matrix == matrix;
    add_smoother(level, finest ? product : level.matrix, ilu_levels, finest ? coupling : nullptr, options_prefix);
  }
}

void Multigrid::add_smoother(Level& level, Mat product, int ilu_levels, InterfaceCoupling* coupling,
                             const char* options_prefix) {
  const bool coarsest = &level == &levels_.back();
  petsc(KSPCreate(PetscObjectComm(reinterpret_cast<PetscObject>(level.matrix)), level.smoother.out()));
  const KSP smoother = level.smoother;
  PC pc = nullptr;
  petsc(KSPGetPC(smoother, &pc));
  petsc(KSPSetOptionsPrefix(smoother, options_prefix));
  petsc(KSPAppendOptionsPrefix(smoother, coarsest ? "mg_coarse_" : "mg_levels_"));
  if (coarsest) {
    petsc(KSPSetOperators(smoother, coarsest_, coarsest_));
    petsc(KSPSetType(smoother, KSPPREONLY));
    set_up_everywhere_lu(pc);
  } else {
    petsc(KSPSetOperators(smoother, product, level.matrix));
    petsc(KSPSetType(smoother, "rrk"));
    set_rrk_step(smoother, 2);
    petsc(KSPSetTolerances(smoother, 0, 0, PETSC_DEFAULT, 1));
    petsc(KSPSetNormType(smoother, KSP_NORM_NONE));
    petsc(KSPSetInitialGuessNonzero(smoother, PETSC_TRUE));
    set_up_block_ilu(pc, ilu_levels, coupling);
  }
  petsc(KSPSetFromOptions(smoother));
}

void Multigrid::renew() {
  for (const auto& c : coarsening_) c->sum_blocks();
  Mat reused = coarsest_;
  petsc(MatConvert(levels_.back().matrix, MATAIJ, MAT_REUSE_MATRIX, &reused));
  for (const Level& level : levels_) petsc(KSPSetUp(level.smoother));
}

void Multigrid::cycle(size_t i, Vec b, Vec x) {
  if (i < coarsening_.size()) {
    const Level& next = levels_[i + 1];
    coarsening_[i]->restrict_to_coarse(b, next.b);
    cycle(i + 1, next.b, next.x);
    coarsening_[i]->prolong(next.x, x);
  }
  petsc(KSPSolve(levels_[i].smoother, b, x));
}

}  // namespace windhover::fluid
