#include "fluid/block_jacobian.h"

#include <algorithm>

#include "fluid/block_matrix.h"

namespace windhover::fluid {

using mesh::Index;

namespace {

constexpr int kEntries = kVariables * kVariables;

}  // namespace

BlockJacobian::BlockJacobian(const mesh::Mesh& mesh) {
  preallocate(mesh);
  find_slots(mesh);
}

void BlockJacobian::preallocate(const mesh::Mesh& mesh) {
  std::vector<PetscInt> inside(mesh.n_owned, 1), outside(mesh.n_owned, 0);
  const auto count = [&](Index row, Index column) {
    if (row < mesh.n_owned) ++(column < mesh.n_owned ? inside : outside)[row];
  };
  for (const auto& b : mesh.faces)
    for (int i = 0; i < b.count; ++i) count(b.cell[0][i], b.cell[1][i]), count(b.cell[1][i], b.cell[0][i]);
  const PetscInt n = kVariables * mesh.n_owned;
  petsc(MatCreateBAIJ(mesh.comm, kVariables, n, n, PETSC_DETERMINE, PETSC_DETERMINE, 0, inside.data(), 0,
                      outside.data(), matrix_.out()));
  // an entry for each pair of neighbours fixes the pattern
  const double zero[kEntries] = {};
  const auto insert = [&](Index row, Index column) {
    if (row < mesh.n_owned)
      petsc(MatSetValuesBlocked(matrix_, 1, &mesh.global_cell[row], 1, &mesh.global_cell[column], zero, INSERT_VALUES));
  };
  for (Index c = 0; c < mesh.n_owned; ++c) insert(c, c);
  for (const auto& b : mesh.faces)
    for (int i = 0; i < b.count; ++i) insert(b.cell[0][i], b.cell[1][i]), insert(b.cell[1][i], b.cell[0][i]);
  finish();
}

void BlockJacobian::find_slots(const mesh::Mesh& mesh) {
  const BlockParts parts = block_parts(matrix_);
  const BlockPattern inside(parts.inside);
  std::optional<BlockPattern> outside;
  if (parts.outside) outside.emplace(parts.outside);
  const auto slot = [&](Index row, Index column) -> Slot {
    if (row >= mesh.n_owned) return kNone;
    if (column < mesh.n_owned) return inside.find(row, column);
    const PetscInt* end = parts.outside_columns + parts.n_outside;
    const auto local = std::lower_bound(parts.outside_columns, end, mesh.global_cell[column]) - parts.outside_columns;
    return ~outside->find(row, static_cast<Index>(local));
  };
  face_.reserve(mesh.faces.size() * mesh::kLanes);
  for (const auto& b : mesh.faces)
    for (int i = 0; i < mesh::kLanes; ++i) {
      const Index l = b.cell[0][i], r = b.cell[1][i];
      face_.push_back(i < b.count ? std::array{slot(l, r), slot(r, l)} : std::array{kNone, kNone});
    }
  for (Index c = 0; c < mesh.n_owned; ++c) diagonal_.push_back(inside.find(c, c));
}

void BlockJacobian::begin() {
  petsc(MatZeroEntries(matrix_));
  petsc(MatSeqBAIJGetArray(block_parts(matrix_).inside, &inside_));
  if (block_parts(matrix_).outside) petsc(MatSeqBAIJGetArray(block_parts(matrix_).outside, &outside_));
}

void BlockJacobian::add_face(size_t face, const Cells& cells, int side, const double* block, double scale) {
  for (int row = 0; row < 2; ++row) {
    double* to = row == side ? diagonal(cells[row]) : neighbour(face_[face][row]);
    if (!to) continue;
    const double sign = row == 0 ? scale : -scale;
    for (int k = 0; k < kEntries; ++k) to[k] += sign * block[k];
  }
}

void BlockJacobian::add_diagonal(Index cell, const double* block, double scale) {
  double* to = diagonal(cell);
  for (int k = 0; k < kEntries; ++k) to[k] += scale * block[k];
}

void BlockJacobian::add_identity(Index cell, double value) {
  double* to = diagonal(cell);
  for (int k = 0; k < kVariables; ++k) to[(kVariables + 1) * k] += value;
}

void BlockJacobian::finish() {
  if (inside_) petsc(MatSeqBAIJRestoreArray(block_parts(matrix_).inside, &inside_));
  if (outside_) petsc(MatSeqBAIJRestoreArray(block_parts(matrix_).outside, &outside_));
  inside_ = outside_ = nullptr;
  petsc(MatAssemblyBegin(matrix_, MAT_FINAL_ASSEMBLY));
  petsc(MatAssemblyEnd(matrix_, MAT_FINAL_ASSEMBLY));
}

}  // namespace windhover::fluid
