// Assembly of the first-order Jacobian, the matrix the preconditioners are made from.
#include <algorithm>

#include "fluid/euler.h"

namespace windhover::fluid {

using mesh::FaceBlock;
using mesh::Index;

namespace {

template <class Visit>
void for_each_face(const std::vector<FaceBlock>& blocks, Visit visit) {
  for (const FaceBlock& b : blocks)
    for (int i = 0; i < b.count; ++i) visit(b.cell[0][i], b.cell[1][i]);
}

/// Lane i of a block of packs, as the 25 numbers MatSetValuesBlocked wants (row-major).
void extract(const BlockPack& packs, int lane, double sign, double out[25]) {
  for (int r = 0; r < kVariables; ++r)
    for (int c = 0; c < kVariables; ++c) out[5 * r + c] = sign * packs[c * kVariables + r][lane];
}

}  // namespace

MatHandle EulerOperator::make_jacobian(MatType type) const {
  std::vector<PetscInt> inside(mesh_.n_owned, 1), outside(mesh_.n_owned, 0);
  const auto count = [&](Index row, Index column) {
    if (row < mesh_.n_owned && row != column) ++(column < mesh_.n_owned ? inside : outside)[row];
  };
  for_each_face(mesh_.faces, [&](Index l, Index r) { count(l, r), count(r, l); });
  MatHandle matrix;
  const PetscInt n = kVariables * mesh_.n_owned;
  petsc(MatCreate(mesh_.comm, matrix.out()));
  petsc(MatSetSizes(matrix, n, n, PETSC_DETERMINE, PETSC_DETERMINE));
  petsc(MatSetBlockSize(matrix, kVariables));
  petsc(MatSetType(matrix, type));
  petsc(MatXAIJSetPreallocation(matrix, kVariables, inside.data(), outside.data(), nullptr, nullptr));
  petsc(MatSetOption(matrix, MAT_NO_OFF_PROC_ENTRIES, PETSC_TRUE));
  return matrix;
}

void EulerOperator::first_order_jacobian(Vec q, const Frames& frames, double scale, double mass_scale, Mat matrix) {
  load_cells(q, frames, nullptr, cells_);
  petsc(MatZeroEntries(matrix));
  double block[25];
  const auto insert = [&](Index row, Index column, const BlockPack& packs, int lane, double sign) {
    if (row >= mesh_.n_owned) return;
    extract(packs, lane, sign, block);
    petsc(MatSetValuesBlocked(matrix, 1, &mesh_.global_cell[row], 1, &mesh_.global_cell[column], block, ADD_VALUES));
  };
  for_each_group(
      frames,
      [&](const FaceInput& in, const FaceBlock* blocks, int n) {
        BlockPack sides[2];
        for (const FaceBlock* b = blocks; b < blocks + n; ++b) {
          model_.flux->jacobian(in, *b, sides);
          for (int i = 0; i < b->count; ++i)
            for (int s = 0; s < 2; ++s) {
              insert(b->cell[0][i], b->cell[s][i], sides[s], i, scale);
              insert(b->cell[1][i], b->cell[s][i], sides[s], i, -scale);
            }
        }
      },
      [&](const FaceInput& in, BoundaryKind kind, const FaceBlock* blocks, int n, int) {
        BlockPack side;
        for (const FaceBlock* b = blocks; b < blocks + n; ++b) {
          kBoundaryKernels.jacobian(in, kind, *b, side);
          for (int i = 0; i < b->count; ++i) insert(b->cell[0][i], b->cell[0][i], side, i, scale);
        }
      });
  for (Index c = 0; c < mesh_.n_owned; ++c) {
    std::fill(block, block + 25, 0.0);
    for (int k = 0; k < kVariables; ++k) block[6 * k] = mass_scale * mesh_.volume[c];
    petsc(MatSetValuesBlocked(matrix, 1, &mesh_.global_cell[c], 1, &mesh_.global_cell[c], block, ADD_VALUES));
  }
  petsc(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
  petsc(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
}

}  // namespace windhover::fluid
