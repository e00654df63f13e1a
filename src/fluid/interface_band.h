// What crosses sliding interfaces, for preconditioners whose matrix does not hold it: guessed from factors of the cells near
// an interface alone: as near as this rank's own faces lead.
#pragma once
#include <vector>

#include "fluid/block_ilu.h"
#include "fluid/block_matrix.h"
#include "fluid/interface_coupling.h"

namespace windhover::fluid {

class InterfaceBand {
 public:
  /// `whole`: the matrix A of this rank's own cells; so many layers of cells beside an interface's own.
  InterfaceBand(InterfaceCoupling& coupling, const BlockPattern& whole, int layers);

  /// Blocks of the whole matrix, one after the other. False: some pivot cannot be inverted.
  bool factor(const double* blocks);
  /// The rows of x near interfaces get B⁻¹ (1 − C D⁻¹) b. Collective.
  void solve(const float* b, float* x);
  /// changed = b − C x at the coupling's cells, with B x = b − C D⁻¹ b by incomplete factors of B, A's part near an
  /// interface, and D their pivots. b: five values per owned cell. Collective.
  void right_side(const float* b, float* changed);

 private:
  struct Pattern {
    std::vector<int> start{0}, column;
  };
  Pattern cut(const BlockPattern& whole);
  template <class At>
  void subtract_product(const float* b, const At& at, float* changed);
  void solve(const float* b);

  InterfaceCoupling& coupling_;
  std::vector<mesh::Index> cells_;  ///< near an interface, ascending
  std::vector<int> from_;           ///< where each block of B is in the whole matrix
  BlockIlu factors_;
  std::vector<int> at_interface_;  ///< places among cells_ of those at an interface
  std::vector<float> b_, x_;      ///< of cells_
  std::vector<float> changed_;    ///< right sides of the coupling's cells
};

}  // namespace windhover::fluid
