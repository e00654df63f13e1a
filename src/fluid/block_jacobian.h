// The assembled first-order Jacobian: 5x5 blocks for every cell and its face neighbours, written in place.
#pragma once
#include <array>
#include <optional>
#include <vector>

#include "base/petsc.h"
#include "fluid/flux_kernels.h"
#include "mesh/mesh.h"

namespace windhover::fluid {

/// A PETSc BAIJ matrix whose blocks are reached by the faces' own numbers instead of by searching rows.
class BlockJacobian {
 public:
  explicit BlockJacobian(const mesh::Mesh& mesh);

  Mat matrix() const { return matrix_; }

  /// Between begin() and finish(): sums of blocks.
  void begin();
  /// Face `face` counts the lanes of all interior blocks in order, padding included. Adds scale · side to the rows of
  /// the left cell and subtracts it from the right cell's, in the column of the cell on that side.
  void add_face(size_t face, int side, const double* block, double scale);
  /// Asks for the blocks of a face before they are added to.
  void prefetch_face(size_t face) {
    for (const Slot& s : face_[face])
      if (s.offset >= 0)
        for (int k = 0; k < 25; k += 8) __builtin_prefetch(block_at(s) + k, 1);
  }
  void add_diagonal(mesh::Index cell, const double* block, double scale);
  /// Adds value on the diagonal of the cell's own block.
  void add_identity(mesh::Index cell, double value);
  void finish();

 private:
  struct Slot {
    int offset = -1;       ///< of the block in its array, in blocks; −1: not this rank's row
    bool outside = false;  ///< in the off-process part
  };
  double* block_at(const Slot& s) { return (s.outside ? outside_ : inside_) + size_t(s.offset) * 25; }
  void preallocate(const mesh::Mesh& mesh);
  void find_slots(const mesh::Mesh& mesh);

  MatHandle matrix_;
  std::vector<std::array<Slot, 4>> face_;  ///< (left, left), (left, right), (right, left), (right, right)
  std::vector<int> diagonal_;
  double *inside_ = nullptr, *outside_ = nullptr;
};

}  // namespace windhover::fluid
