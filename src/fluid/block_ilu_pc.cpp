#include "fluid/block_ilu_pc.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>

#include "fluid/block_ilu.h"
#include "fluid/interface_band.h"
#include "fluid/overlapping_rows.h"
#include "mesh/remote_rows.h"

namespace windhover::fluid {
namespace {

/// Incomplete factors of this rank's own rows and one layer of other ranks' rows around them.
class OverlappingIlu {
 public:
  OverlappingIlu(Mat matrix, int levels, InterfaceCoupling* coupling);

  bool factor();
  /// x = what the factors make of b, own rows of both. Collective.
  void solve(const float* b, float* x);
  void solve(const double* b, double* x);
  void solve_near_interfaces(const float* b, float* x) { near_->solve(b, x); }

 private:
  typedef std::array<float, kVariables> Five;

  Mat inside_;  ///< own rows and columns of the matrix
  OverlappingRows rows_;
  BlockIlu factors_;
  std::optional<InterfaceBand> band_;  ///< for right sides
  std::optional<InterfaceBand> near_;
  std::vector<int> changed_rows_;  ///< other ranks' rows and own ones at interfaces
  std::vector<float> changed_;     ///< their right sides
  mesh::RemoteRows others_;        ///< from other ranks' right sides to changed_
  std::vector<float> rounded_;     ///< what is solved in place of doubles
};

OverlappingIlu::OverlappingIlu(Mat matrix, int levels, InterfaceCoupling* coupling)
    : inside_(block_parts(matrix).inside), rows_(matrix), factors_([&] {
        const OverlappingRows::Pattern pattern = rows_.pattern();
        return BlockIlu(rows_.rows(), pattern.start.data(), pattern.column.data(), levels,
                        {rows_.before(), rows_.own()});
      }()) {
  if (coupling) {
    constexpr int kLayers = 3;
    band_.emplace(*coupling, BlockPattern(inside_), kLayers);
    near_.emplace(*coupling, BlockPattern(inside_), kNearInterfaces);
  }
  changed_rows_.resize(rows_.before());
  std::iota(changed_rows_.begin(), changed_rows_.end(), 0);
  if (coupling)
    for (const mesh::Index cell : coupling->cells()) changed_rows_.push_back(rows_.before() + cell);
  for (int row = rows_.before() + rows_.own(); row < rows_.rows(); ++row) changed_rows_.push_back(row);
  changed_.resize(kVariables * changed_rows_.size());
  others_ =
      mesh::RemoteRows(PetscObjectComm(reinterpret_cast<PetscObject>(matrix)), rows_.forest(changed_rows_.size()));
}

bool OverlappingIlu::factor() {
  const bool regular = factors_.factor(rows_.blocks());
  if (!band_) return regular;
  PetscScalar* blocks = nullptr;
  petsc(MatSeqBAIJGetArray(inside_, &blocks));
  const bool band_regular = band_->factor(blocks) && near_->factor(blocks);
  petsc(MatSeqBAIJRestoreArray(inside_, &blocks));
  return regular && band_regular;
}

void OverlappingIlu::solve(const float* b, float* x) {
  const auto others = reinterpret_cast<Five*>(changed_.data());
  others_.begin(reinterpret_cast<const Five*>(b), others);
  if (band_) band_->right_side(b, changed_.data() + kVariables * rows_.before());
  others_.end(others);
  factors_.solve(b, x, {changed_rows_, changed_.data()});
}

void OverlappingIlu::solve(const double* b, double* x) {
  rounded_.assign(b, b + kVariables * rows_.own());
  solve(rounded_.data(), rounded_.data());
  std::copy(rounded_.begin(), rounded_.end(), x);
}

/// The pattern is known when the matrix has its first values.
struct LateIlu {
  int levels;
  InterfaceCoupling* coupling;
  std::optional<OverlappingIlu> ilu;
};

LateIlu& late_ilu(PC pc) {
  void* context = nullptr;
  petsc(PCShellGetContext(pc, &context));
  return *static_cast<LateIlu*>(context);
}

PetscErrorCode factor_ilu(PC pc) {
  return CallbackGuard().run([pc] {
    LateIlu& late = late_ilu(pc);
    Mat matrix = nullptr;
    petsc(PCGetOperators(pc, nullptr, &matrix));
    if (!late.ilu) late.ilu.emplace(matrix, late.levels, late.coupling);
    int regular = late.ilu->factor();
    MPI_Allreduce(MPI_IN_PLACE, &regular, 1, MPI_INT, MPI_MIN, PetscObjectComm(reinterpret_cast<PetscObject>(pc)));
    petsc(PCSetFailedReason(pc, regular ? PC_NOERROR : PC_FACTOR_NUMERIC_ZEROPIVOT));
  });
}

PetscErrorCode apply_ilu(PC pc, Vec b, Vec x) {
  return CallbackGuard().run([=] {
    const double* from = nullptr;
    double* to = nullptr;
    petsc(VecGetArrayRead(b, &from));
    petsc(VecGetArrayWrite(x, &to));
    late_ilu(pc).ilu->solve(from, to);
    petsc(VecRestoreArrayWrite(x, &to));
    petsc(VecRestoreArrayRead(b, &from));
  });
}

PetscErrorCode destroy_ilu(PC pc) {
  return CallbackGuard().run([pc] { delete &late_ilu(pc); });
}

}  // namespace

void set_up_block_ilu(PC pc, int levels, InterfaceCoupling* coupling) {
  petsc(PCSetType(pc, PCSHELL));
  petsc(PCShellSetName(pc, "block ILU in bytes"));
  petsc(PCShellSetContext(pc, new LateIlu{levels, coupling, {}}));
  petsc(PCShellSetSetUp(pc, factor_ilu));
  petsc(PCShellSetApply(pc, apply_ilu));
  petsc(PCShellSetDestroy(pc, destroy_ilu));
}

void apply_block_ilu(PC pc, const float* b, float* x) { late_ilu(pc).ilu->solve(b, x); }

void apply_near_interfaces(PC pc, const float* b, float* x) { late_ilu(pc).ilu->solve_near_interfaces(b, x); }

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
