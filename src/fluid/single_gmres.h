// Flexible GMRES (PETSc) on vectors of floats.
#pragma once
#include <functional>

#include "base/petsc.h"

namespace windhover::fluid {

/// Half the memory to be read of vectors of doubles, for solves that ask for a few digits.
class SingleGmres {
 public:
  /// y = A x, y = M⁻¹ x: vectors of n floats on this rank (single_vector.h). Collective.
  typedef std::function<void(Vec x, Vec y)> Operation;
  SingleGmres(MPI_Comm comm, PetscInt n, Operation multiply, Operation precondition);
  SingleGmres(const SingleGmres&) = delete;
  SingleGmres& operator=(const SingleGmres&) = delete;

  KSP ksp() const { return ksp_; }
  /// Vectors for KSPSolve().
  Vec right_side() const { return b_; }
  Vec solution() const { return x_; }
  /// Throws what a product or the preconditioner threw.
  void rethrow() { guard_.rethrow(); }

 private:
  static PetscErrorCode multiply(Mat, Vec x, Vec y);
  static PetscErrorCode precondition(PC, Vec x, Vec y);

  CallbackGuard guard_;
  Operation multiply_, precondition_;
  VecHandle b_, x_;
  MatHandle product_;
  KspHandle ksp_;
};

}  // namespace windhover::fluid
