#include "fluid/preconditioner.h"

#include <set>

#include "base/errors.h"

namespace windhover::fluid {
namespace {

void set_sub_ilu(PC pc, int levels, bool in_place) {
  const char* prefix = nullptr;
  petsc(PCGetOptionsPrefix(pc, &prefix));
  const std::string p = prefix ? prefix : "";
  // the sub-solvers exist only after the matrix is known; options reach them then. What an earlier solver set here is
  // not the user's word
  static std::set<std::string> ours;
  const auto set_default = [&](const std::string& name, const std::string& value) {
    PetscBool has = PETSC_FALSE;
    petsc(PetscOptionsHasName(nullptr, p.c_str(), ("-" + name).c_str(), &has));
    if (has && !ours.contains(p + name)) return;
    ours.insert(p + name);
    petsc(PetscOptionsSetValue(nullptr, ("-" + p + name).c_str(), value.c_str()));
  };
  set_default("sub_pc_type", "ilu");
  set_default("sub_pc_factor_levels", std::to_string(levels));
  set_default("sub_pc_factor_in_place", in_place ? "true" : "false");
}

void set_up_ilu(PC pc, int levels, int) {
  petsc(PCSetType(pc, PCBJACOBI));
  set_sub_ilu(pc, levels, levels == 0);  // the factor has the Jacobian's pattern and takes its place: a fifth less memory
}

void set_up_asm(PC pc, int levels, int) {
  petsc(PCSetType(pc, PCASM));
  petsc(PCASMSetOverlap(pc, 1));
  set_sub_ilu(pc, levels, false);
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

const Preconditioner kPreconditioners[5] = {
    {"ilu", true, false, set_up_ilu},
    {"asm", true, false, set_up_asm},
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
