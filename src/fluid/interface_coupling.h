// How the cells on both sides of a sliding interface act on each other: what the assembled Jacobian cannot hold, since
// they are others at every step.
#pragma once
#include <memory>
#include <vector>

#include "base/mpi_type.h"
#include "fluid/euler.h"

namespace windhover::fluid {

/// The first-order Jacobian's blocks C between zones at the present frames.
class InterfaceCoupling {
 public:
  explicit InterfaceCoupling(EulerOperator& euler);

  /// C = scale dR/dq of the first-order scheme between zones, in the axes from which `turn` leads to those of `frames`.
  void renew(Vec q, const Frames& frames, double scale, const ZoneTurn& turn);
  /// This rank's cells at an interface and so many layers of neighbours, ascending.
  std::vector<mesh::Index> cells_within(int layers) const;
  /// sum −= C x, five values per owned cell. x is asked for where it counts: at(cell, to) writes the five floats of an
  /// owned cell. Collective.
  template <class At>
  void subtract_product(At&& at, double* sum) {
    for (const mesh::Index c : cells_) at(c, x_.get() + size_t(kVariables) * c);
    subtract_product(sum);
  }

 private:
  void subtract_product(double* sum);

  EulerOperator& euler_;
  MpiType five_{kVariables, MPI_FLOAT};
  std::vector<InterfaceBlock> blocks_;
  std::vector<mesh::Index> cells_;  ///< owned, at an interface
  std::unique_ptr<float[]> x_;      ///< five per row of SlidingFaces; only those at an interface are ever touched
};

}  // namespace windhover::fluid
