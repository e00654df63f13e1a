#include "fluid/sliding_faces.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/collective.h"

namespace windhover::fluid {

using mesh::FaceBlock;
using mesh::Vec3;

SlidingFaces::SlidingFaces(const mesh::Mesh& mesh, std::vector<mesh::SlidingInterface> interfaces)
    : mesh_(mesh), rank_(rank_of(mesh.comm)), interfaces_(std::move(interfaces)), n_cells_(mesh.n_cells) {
  if (!empty()) number_cells();
}

bool SlidingFaces::covers(int patch) const {
  return std::any_of(interfaces_.begin(), interfaces_.end(),
                     [&](const auto& i) { return i.patch(0) == patch || i.patch(1) == patch; });
}

void SlidingFaces::number_cells() {
  const auto is_here = [this](const mesh::SlidingInterface& interface) {
    for (int side = 0; side < 2; ++side)
      for (const auto& face : interface.faces(side))
        if (face.rank == rank_) return true;
    return false;
  };
  std::map<std::pair<int, mesh::Index>, int> row_of;  // remote cell → its row here
  for (const auto& interface : interfaces_)
    for (int side = 0; side < 2 && is_here(interface); ++side)
      for (const auto& face : interface.faces(side))
        if (face.rank != rank_) row_of[{face.rank, face.cell}] = 0;
  std::vector<PetscSFNode> roots;
  std::vector<PetscInt> leaves;
  for (auto& [cell, row] : row_of) {
    row = n_cells_++;
    roots.push_back({cell.first, cell.second});
    leaves.push_back(row);
  }
  for (const auto& interface : interfaces_) {
    auto& rows = face_cell_.emplace_back();
    const bool here = is_here(interface);
    for (int side = 0; side < 2; ++side)
      for (const auto& face : interface.faces(side))
        rows[side].push_back(!here ? -1 : face.rank == rank_ ? face.cell : row_of.at({face.rank, face.cell}));
  }
  SfHandle forest;
  petsc(PetscSFCreate(mesh_.comm, forest.out()));
  petsc(PetscSFSetGraph(forest, mesh_.n_owned, static_cast<PetscInt>(leaves.size()), leaves.data(), PETSC_COPY_VALUES,
                        roots.data(), PETSC_COPY_VALUES));
  remote_ = mesh::RemoteRows(mesh_.comm, forest);
}

std::vector<mesh::Index> SlidingFaces::own_cells() const {
  std::vector<mesh::Index> cells;
  for (const auto& sides : face_cell_)
    for (const auto& side : sides)
      for (const int row : side)
        if (row >= 0 && row < mesh_.n_owned) cells.push_back(row);
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

/// By which angle the inner zone is turned about the interface's axis, relative to the parent.
double SlidingFaces::angle(const mesh::SlidingInterface& interface, const Frames& frames) const {
  const mesh::Mat3 turned = frames[interface.zone(1)].R.transpose() * frames[interface.zone(0)].R;
  const Vec3 axis = interface.axis(), x = axis.unitOrthogonal(), moved = turned * x;
  return std::atan2(axis.dot(x.cross(moved)), x.dot(moved));
}

void SlidingFaces::make_faces(size_t i, const std::vector<mesh::Piece>& pieces, InterfaceFaces& faces) const {
  const auto is_own = [&](int side, int face) { return interfaces_[i].faces(side)[face].rank == rank_; };
  faces.clear();
  const auto append = [&](bool inner_is_own) {
    bool full = true;
    for (const mesh::Piece& piece : pieces) {
      if (is_own(0, piece.inner) != inner_is_own) continue;
      if (full) faces.push_back({});
      FaceBlock& b = faces.back();
      const int lane = b.count++;
      full = b.count == mesh::kLanes;
      const int cell[2] = {face_cell_[i][0][piece.inner], face_cell_[i][1][piece.outer]};
      for (int d = 0; d < 3; ++d) {
        b.area[d][lane] = piece.area[d];
        b.moment[d][lane] = piece.moment[d];
        for (int side = 0; side < 2; ++side) b.arm[lane][side][d] = piece.arm[side][d];
      }
      // padding lanes read the first lane's cells
      for (int side = 0; side < 2; ++side)
        for (int l = lane; l < mesh::kLanes && (l == lane || lane == 0); ++l) b.cell[side][l] = cell[side];
    }
  };
  faces.reserve(pieces.size() / mesh::kLanes + 2);
  // a block's own cells are on the same side, since only the other side's derivative is wanted
  append(true), append(false);
}

SlidingFaces::Position& SlidingFaces::position(const Frames& frames) {
  std::vector<double> angles;
  for (const auto& interface : interfaces_) angles.push_back(angle(interface, frames));
  for (Position& p : positions_)
    if (p.angles == angles) return p;
  constexpr size_t kept = 3;
  Position position;
  if (positions_.size() == kept) {
    position = std::move(positions_.front());  // its memory serves again
    positions_.pop_front();
  }
  position.angles = angles;
  position.faces.resize(interfaces_.size());
  for (size_t i = 0; i < interfaces_.size(); ++i) interfaces_[i].cut(angles[i]);
  for (size_t i = 0; i < interfaces_.size(); ++i) {
    const std::vector<mesh::Piece>& pieces = interfaces_[i].hand_out();
    interfaces_[i].audit(angles[i], pieces);
    make_faces(i, pieces, position.faces[i]);
  }
  for (auto& faces : position.single) faces.clear();
  positions_.push_back(std::move(position));
  return positions_.back();
}

const std::vector<InterfaceFacesOf<float>>& SlidingFaces::single(Position& p) {
  p.single.resize(p.faces.size());
  for (size_t i = 0; i < p.faces.size(); ++i)
    if (p.single[i].empty()) p.single[i].assign(p.faces[i].begin(), p.faces[i].end());
  return p.single;
}

}  // namespace windhover::fluid
