// Sums over a distributed mesh that several mesh tests need.
#pragma once
#include <algorithm>
#include <vector>

#include "mesh/mesh.h"

namespace windhover::mesh {

inline double total(double local, MPI_Comm comm) {
  double sum = 0;
  MPI_Allreduce(&local, &sum, 1, MPI_DOUBLE, MPI_SUM, comm);
  return sum;
}

inline double largest(double local, MPI_Comm comm) {
  double worst = 0;
  MPI_Allreduce(&local, &worst, 1, MPI_DOUBLE, MPI_MAX, comm);
  return worst;
}

inline double owned_volume(const Mesh& mesh) {
  double volume = 0;
  for (Index i = 0; i < mesh.n_owned; ++i) volume += mesh.volume[i];
  return total(volume, mesh.comm);
}

/// Calls visit(block, lane, on_boundary) for every face of the rank.
template <class Visit>
void for_each_face(const Mesh& mesh, Visit&& visit) {
  for (const FaceBlock& block : mesh.faces)
    for (int lane = 0; lane < block.count; ++lane) visit(block, lane, false);
  for (const Patch& patch : mesh.patches)
    for (const FaceBlock& block : patch.blocks)
      for (int lane = 0; lane < block.count; ++lane) visit(block, lane, true);
}

inline Vec3 area_of(const FaceBlock& block, int lane) {
  return {block.area[0][lane], block.area[1][lane], block.area[2][lane]};
}
inline Vec3 moment_of(const FaceBlock& block, int lane) {
  return {block.moment[0][lane], block.moment[1][lane], block.moment[2][lane]};
}
inline Vec3 arm_of(const FaceBlock& block, int lane, int side) { return Vec3(block.arm[lane][side]); }

/// Largest |Σ A| and |Σ M| of an owned cell, relative to its surface (lengths of order 1 about the origin).
struct Opening {
  double area = 0, moment = 0;
};
inline Opening opening(const Mesh& mesh) {
  std::vector<Vec3> area(mesh.n_cells, Vec3::Zero()), moment = area;
  std::vector<double> surface(mesh.n_cells, 0);
  for_each_face(mesh, [&](const FaceBlock& block, int lane, bool boundary) {
    for (int side = 0; side < (boundary ? 1 : 2); ++side) {
      const double sign = side == 0 ? 1 : -1;
      area[block.cell[side][lane]] += sign * area_of(block, lane);
      moment[block.cell[side][lane]] += sign * moment_of(block, lane);
      surface[block.cell[side][lane]] += area_of(block, lane).norm();
    }
  });
  Opening worst;
  for (Index i = 0; i < mesh.n_owned; ++i) {
    worst.area = std::max(worst.area, area[i].norm() / surface[i]);
    worst.moment = std::max(worst.moment, moment[i].norm() / surface[i]);
  }
  return {largest(worst.area, mesh.comm), largest(worst.moment, mesh.comm)};
}

/// Faces of the whole mesh: those between ranks count once.
struct FaceCount {
  double interior = 0, boundary = 0;
};
inline FaceCount count_faces(const Mesh& mesh) {
  FaceCount count;
  for_each_face(mesh, [&](const FaceBlock& block, int lane, bool boundary) {
    const bool shared = block.cell[0][lane] >= mesh.n_owned || block.cell[1][lane] >= mesh.n_owned;
    (boundary ? count.boundary : count.interior) += shared ? 0.5 : 1;
  });
  return {total(count.interior, mesh.comm), total(count.boundary, mesh.comm)};
}

}  // namespace windhover::mesh
