#include "mesh/quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "mesh/cell_shape.h"
#include "mesh/face_geometry.h"

namespace windhover::mesh {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

void take_smaller(Worst& worst, double value, const Vec3& place) {
  if (value < worst.value) worst = {value, place};
}

std::array<Vec3, 8> corners_of(const Mesh& mesh, Index cell) {
  std::array<Vec3, 8> corners;
  const Index begin = mesh.cell_point_start[cell];
  for (int i = 0; i < point_count(mesh.type[cell]); ++i) corners[i] = mesh.point[mesh.cell_point[begin + i]];
  return corners;
}

/// Each edge of a cell lies in two of its faces, once in each direction.
void measure_cell(CellType type, const std::array<Vec3, 8>& corners, Quality& quality) {
  const auto faces = faces_of(type);
  Vec3 normal[6];
  int face_of_edge[8][8];
  for (std::size_t f = 0; f < faces.size(); ++f) {
    std::array<Vec3, 4> p;
    for (int i = 0; i < faces[f].n; ++i) {
      p[i] = corners[faces[f].point[i]];
      face_of_edge[faces[f].point[i]][faces[f].point[(i + 1) % faces[f].n]] = static_cast<int>(f);
    }
    normal[f] = face_geometry(std::span(p).first(faces[f].n)).area.normalized();
  }
  for (const ShapeFace& face : faces)
    for (int i = 0; i < face.n; ++i) {
      const int a = face.point[i], b = face.point[(i + 1) % face.n];
      if (a > b) continue;
      const Vec3 middle = (corners[a] + corners[b]) / 2;
      take_smaller(quality.smallest_edge, (corners[b] - corners[a]).norm(), middle);
      const Vec3 &m = normal[face_of_edge[a][b]], &n = normal[face_of_edge[b][a]];
      const double angle = std::numbers::pi - std::acos(std::clamp(m.dot(n), -1.0, 1.0));
      take_smaller(quality.smallest_dihedral_deg, angle * 180 / std::numbers::pi, middle);
    }
}

/// The smallest value of all ranks, with its place.
void reduce(Worst& worst, MPI_Comm comm) {
  struct {
    double value;
    int rank;
  } local{worst.value, 0}, global{};
  MPI_Comm_rank(comm, &local.rank);
  MPI_Allreduce(&local, &global, 1, MPI_DOUBLE_INT, MPI_MINLOC, comm);
  worst.value = global.value;
  MPI_Bcast(worst.place.data(), 3, MPI_DOUBLE, global.rank, comm);
}

}  // namespace

Quality measure_quality(const Mesh& mesh) {
  Quality quality{.smallest_edge = {.value = kNone},
                  .smallest_dihedral_deg = {.value = kNone},
                  .largest_volume_ratio = {.value = -1},
                  .smallest_cell = {.value = kNone}};
  for (Index i = 0; i < mesh.n_owned; ++i) {
    measure_cell(mesh.type[i], corners_of(mesh, i), quality);
    take_smaller(quality.smallest_cell, std::cbrt(mesh.volume[i]), mesh.centroid[i]);
  }
  Worst& ratio = quality.largest_volume_ratio;  // its negative while it is reduced
  for (const FaceBlock& block : mesh.faces)
    for (int lane = 0; lane < block.count; ++lane) {
      const int a = block.cell[0][lane], b = block.cell[1][lane];
      const double r = mesh.volume[a] / mesh.volume[b];
      take_smaller(ratio, -std::max(r, 1 / r), mesh.centroid[a] + Vec3(block.arm[lane][0]));
    }
  for (Worst* worst : {&quality.smallest_edge, &quality.smallest_dihedral_deg, &ratio, &quality.smallest_cell}) reduce(*worst, mesh.comm);
  ratio.value = -ratio.value;
  return quality;
}

}  // namespace windhover::mesh
