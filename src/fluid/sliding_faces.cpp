#include "fluid/sliding_faces.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/collective.h"

namespace windhover::fluid {

using mesh::FaceBlock;
using mesh::Vec3;

SlidingFaces::SlidingFaces(const mesh::Mesh& mesh, std::vector<mesh::SlidingInterface> interfaces)
    : mesh_(mesh), rank_(rank_of(mesh.comm)), interfaces_(std::move(interfaces)) {
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
  std::map<std::pair<int, mesh::Index>, mesh::Index> number_of;  // of another rank's cell among the others
  place_.assign(mesh_.n_owned, -1);
  for (const auto& interface : interfaces_)
    for (int side = 0; side < 2 && is_here(interface); ++side)
      for (const auto& face : interface.faces(side))
        if (face.rank == rank_)
          place_[face.cell] = 0;
        else
          number_of[{face.rank, face.cell}] = 0;
  for (mesh::Index c = 0; c < mesh_.n_owned; ++c) {
    if (place_[c] < 0) continue;
    place_[c] = static_cast<mesh::Index>(own_.size());
    own_.push_back(c);
  }
  for (auto& [cell, number] : number_of) {
    if (ranks_.empty() || ranks_.back() != cell.first) {
      ranks_.push_back(cell.first);
      others_end_.emplace_back();
    }
    number = static_cast<mesh::Index>(peer_.size());
    peer_.push_back(static_cast<int>(ranks_.size()) - 1);
    others_end_.back() = number + 1;
  }
  for (const auto& interface : interfaces_) {
    auto& cells = face_cell_.emplace_back();
    const bool here = is_here(interface);
    for (int side = 0; side < 2; ++side)
      for (const auto& face : interface.faces(side))
        cells[side].push_back(!here                ? -1
                              : face.rank == rank_ ? face.cell
                                                   : mesh_.n_cells + number_of.at({face.rank, face.cell}));
  }
}

/// By which angle the inner zone is turned about the interface's axis, relative to the parent.
double SlidingFaces::angle(const mesh::SlidingInterface& interface, const Frames& frames) const {
  const mesh::Mat3 turned = frames[interface.zone(1)].R.transpose() * frames[interface.zone(0)].R;
  const Vec3 axis = interface.axis(), x = axis.unitOrthogonal(), moved = turned * x;
  return std::atan2(axis.dot(x.cross(moved)), x.dot(moved));
}

/// Both ends of an exchange know the pieces that lie between them.
void SlidingFaces::choose_rows(const std::vector<const Pieces*>& pieces, Position& position) const {
  const size_t n_own = own_.size();
  std::vector<char> met(peer_.size()), wanted(ranks_.size() * n_own);
  for (size_t i = 0; i < interfaces_.size() && !peer_.empty(); ++i)
    for (const mesh::Piece& piece : *pieces[i]) {
      const mesh::Index cell[2] = {face_cell_[i][0][piece.inner], face_cell_[i][1][piece.outer]};
      for (int side = 0; side < 2; ++side) {
        const mesh::Index other = cell[side] - mesh_.n_cells;
        if (other < 0) continue;
        met[other] = wanted[peer_[other] * n_own + place_[cell[1 - side]]] = true;
      }
    }
  std::vector<mesh::RemoteRows::Peer> to, from;
  std::vector<mesh::Index> sent;
  mesh::Index row = mesh_.n_cells, other = 0;
  position.row.assign(peer_.size(), -1);
  for (size_t p = 0; p < ranks_.size(); ++p) {
    const mesh::Index first = row, first_sent = static_cast<mesh::Index>(sent.size());
    for (; other < others_end_[p]; ++other)
      if (met[other]) position.row[other] = row++;
    if (row == first) continue;
    for (size_t k = 0; k < n_own; ++k)
      if (wanted[p * n_own + k]) sent.push_back(own_[k]);
    from.push_back({ranks_[p], first, row - first});
    to.push_back({ranks_[p], first_sent, static_cast<mesh::Index>(sent.size()) - first_sent});
  }
  position.others.choose(mesh_.comm, std::move(to), std::move(sent), std::move(from));
}

void SlidingFaces::make_faces(size_t i, const Pieces& pieces, Position& position) const {
  const auto row = [&](int side, int face) {
    const mesh::Index cell = face_cell_[i][side][face], other = cell - mesh_.n_cells;
    return other < 0 ? cell : position.row[other];
  };
  InterfaceFaces& faces = position.faces[i];
  faces.clear();
  const auto append = [&](bool inner_is_own) {
    bool full = true;
    for (const mesh::Piece& piece : pieces) {
      if ((face_cell_[i][0][piece.inner] < mesh_.n_owned) != inner_is_own) continue;
      if (full) faces.push_back({});
      FaceBlock& b = faces.back();
      const int lane = b.count++;
      full = b.count == mesh::kLanes;
      const mesh::Index cell[2] = {row(0, piece.inner), row(1, piece.outer)};
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
  std::vector<const Pieces*> pieces;
  for (size_t i = 0; i < interfaces_.size(); ++i) {
    pieces.push_back(&interfaces_[i].hand_out());
    interfaces_[i].audit(angles[i], *pieces[i]);
  }
  choose_rows(pieces, position);
  for (size_t i = 0; i < interfaces_.size(); ++i) make_faces(i, *pieces[i], position);
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
