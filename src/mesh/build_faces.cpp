#include "mesh/build_faces.h"

#include <algorithm>
#include <array>
#include <tuple>

#include "mesh/cell_shape.h"
#include "mesh/face_geometry.h"

namespace windhover::mesh {
namespace {

/// One face to be kept: side `side` of local cell `cell`, and the local cell behind it (itself on a boundary).
struct Face {
  Index cell = 0, other = 0;
  int side = 0, other_side = 0;
  auto order() const { return std::tuple(std::min(cell, other), std::max(cell, other), side); }
};

class FaceBuilder {
 public:
  FaceBuilder(const MeshPart& part, const Numbering& numbering, Mesh& mesh)
      : part_(part), numbering_(numbering), mesh_(mesh), interior_(mesh.zones.size()), boundary_(mesh.patches.size()) {}

  void collect() {
    for (Index i = 0; i < mesh_.n_owned; ++i) {
      const FileCell& cell = record(i);
      for (int s = 0; s < static_cast<int>(faces_of(cell.type).size()); ++s) add(i, s, cell.sides[s]);
    }
    for (auto* lists : {&interior_, &boundary_})
      for (auto& list : *lists)
        std::sort(list.begin(), list.end(), [](const Face& a, const Face& b) { return a.order() < b.order(); });
  }

  void write() {
    for (std::size_t z = 0; z < mesh_.zones.size(); ++z) {
      mesh_.zones[z].faces.begin = static_cast<Index>(mesh_.faces.size());
      append_blocks(interior_[z], mesh_.faces);
      mesh_.zones[z].faces.end = static_cast<Index>(mesh_.faces.size());
    }
    for (std::size_t p = 0; p < mesh_.patches.size(); ++p) append_blocks(boundary_[p], mesh_.patches[p].blocks);
  }

 private:
  const FileCell& record(Index local) const { return part_.cells[numbering_.cell[local]]; }

  /// The normal points from the lower to the higher cell of the file, whoever owns them: both ranks of a shared face
  /// compute it, and its flux, from the same numbers in the same way.
  void add(Index i, int s, const FileSide& side) {
    if (side.neighbour < 0) {
      boundary_[side.patch].push_back({i, i, s, s});
      return;
    }
    const Index j = numbering_.local[side.neighbour];
    const bool first = record(i).file_cell < record(j).file_cell;
    if (!first && j < mesh_.n_owned) return;  // added from the other side
    interior_[record(i).zone].push_back(first ? Face{i, j, s, side.neighbour_side} : Face{j, i, side.neighbour_side, s});
  }

  FaceGeometry geometry(Index local, int side) const {
    const FileCell& cell = record(local);
    const ShapeFace& shape = faces_of(cell.type)[side];
    std::array<Vec3, 4> corners;
    for (int k = 0; k < shape.n; ++k) corners[k] = cell.corners[shape.point[k]].position;
    return face_geometry(std::span(corners).first(shape.n));
  }

  /// Offset of a node's image at the other cell from the one at this cell: zero but for periodic faces.
  Vec3 shift(const Face& face) const {
    const FileCell &here = record(face.cell), &there = record(face.other);
    const FileCorner& corner = here.corners[faces_of(here.type)[face.side].point[0]];
    const ShapeFace& shape = faces_of(there.type)[face.other_side];
    for (int k = 0; k < shape.n; ++k)
      if (const FileCorner& image = there.corners[shape.point[k]]; image.node == corner.node)
        return image.position - corner.position;
    return Vec3::Zero();
  }

  void append_blocks(const std::vector<Face>& faces, std::vector<FaceBlock>& blocks) const {
    blocks.reserve(blocks.size() + (faces.size() + kLanes - 1) / kLanes);
    for (std::size_t begin = 0; begin < faces.size(); begin += kLanes) {
      FaceBlock& block = blocks.emplace_back();
      block = FaceBlock{};
      block.count = static_cast<int>(std::min<std::size_t>(kLanes, faces.size() - begin));
      for (int lane = 0; lane < kLanes; ++lane) {
        const Face& face = faces[begin + (lane < block.count ? lane : 0)];
        block.cell[0][lane] = face.cell;
        block.cell[1][lane] = face.other;
        if (lane < block.count) write_lane(face, lane, block);
      }
    }
  }

  void write_lane(const Face& face, int lane, FaceBlock& block) const {
    block.side[lane] = static_cast<std::int8_t>(face.side);
    const FaceGeometry g = geometry(face.cell, face.side);
    const Vec3 arm[2] = {g.centroid - mesh_.centroid[face.cell],
                         g.centroid + shift(face) - mesh_.centroid[face.other]};
    for (int d = 0; d < 3; ++d) {
      block.area[d][lane] = g.area[d];
      block.moment[d][lane] = g.moment[d];
      for (int side = 0; side < 2; ++side) block.arm[lane][side][d] = arm[side][d];
    }
  }

  const MeshPart& part_;
  const Numbering& numbering_;
  Mesh& mesh_;
  std::vector<std::vector<Face>> interior_;  // of each zone
  std::vector<std::vector<Face>> boundary_;  // of each patch
};

}  // namespace

void build_faces(const MeshPart& part, const Numbering& numbering, Mesh& mesh) {
  FaceBuilder builder(part, numbering, mesh);
  builder.collect();
  builder.write();
}

}  // namespace windhover::mesh
