#include "fluid/single_gmres.h"

#include "fluid/single_vector.h"

namespace windhover::fluid {

SingleGmres::SingleGmres(MPI_Comm comm, PetscInt n, Operation multiply, Operation precondition)
    : multiply_(std::move(multiply)),
      precondition_(std::move(precondition)),
      b_(make_single_vector(comm, n)),
      x_(make_single_vector(comm, n)) {
  PetscInt entries = 0;
  petsc(VecGetLocalSize(b_, &entries));
  petsc(MatCreateShell(comm, entries, entries, PETSC_DETERMINE, PETSC_DETERMINE, this, product_.out()));
  petsc(MatShellSetOperation(product_, MATOP_MULT, reinterpret_cast<void (*)()>(SingleGmres::multiply)));
  PC pc = nullptr;
  petsc(KSPCreate(comm, ksp_.out()));
  petsc(KSPSetOperators(ksp_, product_, product_));
  petsc(KSPSetType(ksp_, KSPFGMRES));
  petsc(KSPGetPC(ksp_, &pc));
  petsc(PCSetType(pc, PCSHELL));
  petsc(PCShellSetContext(pc, this));
  petsc(PCShellSetApply(pc, SingleGmres::precondition));
}

PetscErrorCode SingleGmres::multiply(Mat matrix, Vec x, Vec y) {
  void* context = nullptr;
  if (const PetscErrorCode code = MatShellGetContext(matrix, &context)) return code;
  auto& self = *static_cast<SingleGmres*>(context);
  return self.guard_.run([&] { self.multiply_(x, y); });
}

PetscErrorCode SingleGmres::precondition(PC pc, Vec x, Vec y) {
  void* context = nullptr;
  if (const PetscErrorCode code = PCShellGetContext(pc, &context)) return code;
  auto& self = *static_cast<SingleGmres*>(context);
  return self.guard_.run([&] { self.precondition_(x, y); });
}

}  // namespace windhover::fluid
