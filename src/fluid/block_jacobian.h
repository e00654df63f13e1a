// The assembled first-order Jacobian: 5x5 blocks for every cell and its face neighbours, written in place.
#pragma once
#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "base/petsc.h"
#include "fluid/flux_kernels.h"
#include "mesh/mesh.h"

namespace windhover::fluid {

/// A PETSc BAIJ matrix whose blocks are reached by the faces' own numbers instead of by searching rows.
class BlockJacobian {
 public:
  using Cells = std::array<mesh::Index, 2>;

  explicit BlockJacobian(const mesh::Mesh& mesh);

  Mat matrix() const { return matrix_; }

  /// Between begin() and finish(): sums of blocks.
  void begin();
  /// Face `face` counts the lanes of all interior blocks in order, padding included; `cells` are its left and right one.
  /// Adds scale · block to the left cell's row and subtracts it from the right one's, in the column of the cell on `side`.
  void add_face(size_t face, const Cells& cells, int side, const double* block, double scale);
  /// Asks for the blocks of a face before they are added to.
  void prefetch_face(size_t face, const Cells& cells) {
    for (int row = 0; row < 2; ++row)
      for (const double* block : {diagonal(cells[row]), neighbour(face_[face][row])})
        for (int k = 0; k < 25 && block; k += 8) __builtin_prefetch(block + k, 1);
  }
  void add_diagonal(mesh::Index cell, const double* block, double scale);
  /// Adds value on the diagonal of the cell's own block.
  void add_identity(mesh::Index cell, double value);
  void finish();

 private:
  /// A block's place in its array, ~place in the off-process part's array, or kNone: not this rank's row.
  using Slot = int;
  static constexpr Slot kNone = std::numeric_limits<Slot>::min();
  double* neighbour(Slot s) {
    if (s == kNone) return nullptr;
    return s >= 0 ? inside_ + size_t(s) * 25 : outside_ + size_t(~s) * 25;
  }
  double* diagonal(mesh::Index cell) {
    return cell < mesh::Index(diagonal_.size()) ? inside_ + size_t(diagonal_[cell]) * 25 : nullptr;
  }
  void preallocate(const mesh::Mesh& mesh);
  void find_slots(const mesh::Mesh& mesh);

  MatHandle matrix_;
  std::vector<std::array<Slot, 2>> face_;  ///< (left, right), (right, left)
  std::vector<int> diagonal_;
  double *inside_ = nullptr, *outside_ = nullptr;
};

}  // namespace windhover::fluid
