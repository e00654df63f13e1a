// How the cells on both sides of a sliding interface act on each other: what the assembled Jacobian cannot hold, since
// they are others at every step.
#pragma once
#include <vector>

#include "fluid/euler.h"

namespace windhover::fluid {

/// The first-order Jacobian's blocks C between zones at the present frames.
class InterfaceCoupling {
 public:
  explicit InterfaceCoupling(EulerOperator& euler);

  /// C = scale dR/dq of the first-order scheme between zones, in the axes from which `turn` leads to those of `frames`.
  void renew(Vec q, const Frames& frames, double scale, const ZoneTurn& turn);
  /// This rank's cells at an interface, ascending.
  const std::vector<mesh::Index>& cells() const { return cells_; }
  /// These and so many layers of neighbours, ascending.
  std::vector<mesh::Index> cells_within(int layers) const;
  /// sum −= C x; sum: five values of each of cells(). x is asked for: at(i, to) writes the five floats of cells()[i]. Collective.
  template <class At>
  void subtract_product(At&& at, float* sum) {
    for (size_t i = 0; i < cells_.size(); ++i) at(i, x_.data() + kVariables * i);
    subtract_product(sum);
  }

 private:
  /// Of a row of SlidingFaces among the cells at interfaces.
  mesh::Index place(mesh::Index row) const;
  void subtract_product(float* sum);

  EulerOperator& euler_;
  const std::vector<mesh::Index>&cells_, &place_;  ///< of SlidingFaces: owned cells at an interface, and where each is
  mesh::RemoteRows others_;                        ///< from their ranks' cells_ to what follows those here
  // what an application touches is numbered without gaps, or it would wait for memory at every block
  std::vector<InterfaceBlock> blocks_;  ///< rows and columns by place()
  std::vector<float> x_;                ///< five each of cells_ and of other ranks' cells that they meet
};

}  // namespace windhover::fluid
