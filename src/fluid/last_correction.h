// The end of a linear solve without another product.
#pragma once
#include <vector>

#include "base/petsc.h"

namespace windhover::fluid {

/// A flexible GMRES may stop where M⁻¹ r, added to x, can be expected to bring the residual where it is to fall: an iteration
/// without its product and orthogonalisation, which only say how much of M⁻¹ r would be best. The residual after it is not
/// known but expected, so this is for who finds it out, as Newton's method does. The residual before it is the last vector of
/// DQGMRES (Saad, Iterative Methods for Sparse Linear Systems, 2nd ed., section 6.5.6), of the basis and the residuals' norms.
class LastCorrection {
 public:
  /// Takes over the convergence test of `ksp`, which starts from nothing and whose matrix tells of its products.
  explicit LastCorrection(KSP ksp);
  ~LastCorrection();
  LastCorrection(const LastCorrection&) = delete;
  LastCorrection& operator=(const LastCorrection&) = delete;

  /// y: the result of a product; flexible GMRES makes the next vector of its basis of it, in place.
  void note_product(Vec y) { basis_.push_back(y); }
  /// After a solve of A x = b: x += M⁻¹ r, if it stopped for that. The basis is gone then.
  void apply(KSP ksp, Vec b, Vec x);

 private:
  static PetscErrorCode test(KSP, PetscInt iteration, PetscReal norm, KSPConvergedReason*, void* self);
  bool expected(double goal) const;

  void* default_test_ = nullptr;
  bool wanted_ = false;
  std::vector<double> norms_;  ///< of the residuals so far
  std::vector<Vec> basis_;     ///< results of products: the basis after the first vector, which is b over its norm
};

}  // namespace windhover::fluid
