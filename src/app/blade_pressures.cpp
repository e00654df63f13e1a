#include "app/blade_pressures.h"

#include <algorithm>
#include <tuple>

#include "base/collective.h"

namespace windhover::app {
namespace {

/// A block like another one's lane, for a place beside the same cell.
void append_lane(std::vector<mesh::FaceBlock>& blocks, const mesh::FaceBlock& from, int lane, const Vec3& arm) {
  if (blocks.empty() || blocks.back().count == mesh::kLanes) blocks.emplace_back(mesh::FaceBlock{});
  mesh::FaceBlock& b = blocks.back();
  const int to = b.count++;
  for (int d = 0; d < 3; ++d) {
    b.area[d][to] = from.area[d][lane];
    b.moment[d][to] = from.moment[d][lane];
    for (int side = 0; side < 2; ++side) b.arm[to][side][d] = arm[d];
  }
  b.side[to] = from.side[lane];
  // padding lanes read the first lane's cell
  for (int side = 0; side < 2; ++side)
    for (int l = to; l < (to == 0 ? mesh::kLanes : to + 1); ++l) b.cell[side][l] = from.cell[0][lane];
}

}  // namespace

/// Sent between ranks as bytes.
struct BladePressures::Own {
  SectionPoint point;
  double dynamic_pressure = 0;
  PetscInt file_cell = 0;
  int face_side = 0, rank = 0, number = 0;  ///< number: among its rank's
  auto order() const {
    return std::tuple(point.blade, point.r_over_R, -point.side, point.x_over_c, file_cell, face_side, rank, number);
  }
};

BladePressures::BladePressures(const BladeFaces& faces, const mesh::Mesh& mesh, double length_m,
                               std::vector<double> sections_r_over_R) {
  std::vector<Own> own;
  for (size_t f = 0; f < faces.all().size(); ++f)
    for (const double r_over_R : sections_r_over_R)
      cut(faces, mesh, length_m, f, r_over_R, own);
  number_points(std::move(own), mesh.comm);
}

void BladePressures::cut(const BladeFaces& faces, const mesh::Mesh& mesh, double length_m, size_t number, double r_over_R,
                         std::vector<Own>& own) {
  const double r_m = r_over_R * faces.rotor().blade.radius_m;
  const BladeFace& face = faces.all()[number];
  const Vec3& along = faces.along(face.blade);
  for (const auto& corner : face.triangles) {
    Vec3 middle = Vec3::Zero();
    int crossings = 0;
    for (int k = 0; k < 3; ++k) {
      const Vec3 &a = corner[k], &b = corner[(k + 1) % 3];
      const double da = along.dot(a) - r_m, db = along.dot(b) - r_m;
      if ((da < 0) == (db < 0)) continue;
      middle += (a + da / (da - db) * (b - a)) / 2;
      ++crossings;
    }
    if (crossings < 2) continue;
    const geometry::BladeSection s = faces.section(face.blade, r_m);
    const Vec3 into = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
    const mesh::Index cell = face.block->cell[0][face.lane];
    own.push_back({{face.blade, r_over_R, (middle - s.quarter_chord).dot(s.back) / s.chord + 0.25,
                    into.dot(s.up) < 0 ? 1 : -1},
                   faces.dynamic_pressure(1, r_m), mesh.file_cell[cell], face.block->side[face.lane], rank_of(mesh.comm),
                   static_cast<int>(own.size())});
    append_lane(blocks_, *face.block, face.lane, (middle + faces.rotor().center_m) / length_m - mesh.centroid[cell]);
  }
}

void BladePressures::number_points(std::vector<Own> own, MPI_Comm comm) {
  const int n_ranks = size_of(comm), rank = rank_of(comm), bytes = static_cast<int>(own.size() * sizeof(Own));
  std::vector<int> count(n_ranks), start(n_ranks + 1, 0);
  MPI_Allgather(&bytes, 1, MPI_INT, count.data(), 1, MPI_INT, comm);
  for (int r = 0; r < n_ranks; ++r) start[r + 1] = start[r] + count[r];
  std::vector<Own> all(start[n_ranks] / sizeof(Own));
  MPI_Allgatherv(own.data(), bytes, MPI_BYTE, all.data(), count.data(), start.data(), MPI_BYTE, comm);
  std::sort(all.begin(), all.end(), [](const Own& a, const Own& b) { return a.order() < b.order(); });
  own_.resize(own.size());
  for (const Own& point : all) {
    if (point.rank == rank) own_[point.number] = static_cast<int>(points_.size());
    points_.push_back(point.point);
    dynamic_pressure_.push_back(point.dynamic_pressure);
  }
}

std::vector<double> BladePressures::values(std::span<const double> pressures, double rpm, MPI_Comm comm) const {
  std::vector<double> values(points_.size(), 0);
  for (size_t i = 0; i < own_.size(); ++i) values[own_[i]] = pressures[i] / (rpm * rpm * dynamic_pressure_[own_[i]]);
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_SUM, comm);
  return values;
}

}  // namespace windhover::app
