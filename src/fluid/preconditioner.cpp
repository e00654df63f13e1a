#include "fluid/preconditioner.h"

#include <optional>
#include <set>

#include "base/errors.h"
#include "fluid/block_ilu_pc.h"
#include "fluid/multigrid.h"
#include "fluid/rrk_smoother.h"

namespace windhover::fluid {
namespace {

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

void set_up_asm(PC pc, int levels, InterfaceCoupling*) {
  petsc(PCSetType(pc, PCASM));
  petsc(PCASMSetOverlap(pc, 1));
  set_defaults(pc, {{"sub_pc_type", "ilu"}, {"sub_pc_factor_levels", std::to_string(levels)}});
}

void set_up_rrk(PC pc, int, InterfaceCoupling*) {
  register_rrk();
  petsc(PCSetType(pc, PCKSP));
  set_defaults(pc, {{"ksp_ksp_type", "rrk"}, {"ksp_ksp_max_it", "3"}, {"ksp_pc_type", "pbjacobi"}});
}

/// Aggregates are chosen when the matrix has its first values.
struct LateMultigrid {
  int ilu_levels;
  InterfaceCoupling* coupling;
  std::optional<Multigrid> cycle;
};

LateMultigrid& multigrid(PC pc) {
  void* context = nullptr;
  petsc(PCShellGetContext(pc, &context));
  return *static_cast<LateMultigrid*>(context);
}

PetscErrorCode renew_multigrid(PC pc) {
  return CallbackGuard().run([pc] {
    LateMultigrid& late = multigrid(pc);
    Mat matrix = nullptr, product = nullptr;
    const char* prefix = nullptr;
    petsc(PCGetOperators(pc, &product, &matrix));
    petsc(PCGetOptionsPrefix(pc, &prefix));
    if (!late.cycle) late.cycle.emplace(product, matrix, late.ilu_levels, late.coupling, prefix);
    late.cycle->renew();
  });
}

PetscErrorCode apply_multigrid(PC pc, Vec b, Vec x) {
  return CallbackGuard().run([=] { multigrid(pc).cycle->apply(b, x); });
}

PetscErrorCode destroy_multigrid(PC pc) {
  return CallbackGuard().run([pc] { delete &multigrid(pc); });
}

void set_up_rrk_multigrid(PC pc, int levels, InterfaceCoupling* coupling) {
  petsc(PCSetType(pc, PCSHELL));
  petsc(PCShellSetName(pc, "aggregation multigrid, rational Runge-Kutta over block ILU"));
  petsc(PCShellSetContext(pc, new LateMultigrid{levels, coupling, {}}));
  petsc(PCShellSetSetUp(pc, renew_multigrid));
  petsc(PCShellSetApply(pc, apply_multigrid));
  petsc(PCShellSetDestroy(pc, destroy_multigrid));
}

void set_up_point_block_jacobi(PC pc, int, InterfaceCoupling*) { petsc(PCSetType(pc, PCPBJACOBI)); }

void set_up_lu(PC pc, int, InterfaceCoupling*) { set_up_everywhere_lu(pc); }

void set_up_none(PC pc, int, InterfaceCoupling*) { petsc(PCSetType(pc, PCNONE)); }

}  // namespace

const Preconditioner kPreconditioners[7] = {
    {"ilu", true, false, true, set_up_block_ilu, apply_block_ilu, apply_near_interfaces},
    {"asm", true, false, false, set_up_asm},
    {"rrk", true, false, false, set_up_rrk},
    {"rrk-multigrid", true, false, true, set_up_rrk_multigrid},
    {"point_block_jacobi", true, false, false, set_up_point_block_jacobi},
    {"lu", true, true, false, set_up_lu},
    {"none", false, false, false, set_up_none},
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
