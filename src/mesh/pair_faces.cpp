#include "mesh/pair_faces.h"

#include <algorithm>
#include <array>
#include <map>
#include <span>

#include "base/errors.h"
#include "mesh/cell_shape.h"
#include "mesh/face_geometry.h"
#include "mesh/plex_file.h"

namespace windhover::mesh {
namespace {

using FaceVertices = std::array<PetscInt, 4>;  // ascending; -1 for a triangle's missing fourth

/// A face and the (at most two) cells that use it.
struct SharedFace {
  FaceVertices vertices;
  PetscInt tag = 0;
  int uses = 0;
  Index cell[2] = {-1, -1};
  int side[2] = {-1, -1};
};

Vec3 middle(const FileCell& cell, const ShapeFace& face) {
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i < face.n; ++i) sum += cell.corners[face.point[i]].position;
  return sum / face.n;
}

/// Says how many faces are wrong in the same way, and where the first is.
class Complaint {
 public:
  Complaint(const std::string& file, double scale) : file_(file), scale_(scale) {}
  void add(const FileMesh& mesh, Index cell, int side) {
    if (count_++ > 0) return;
    cell_ = cell;
    place_ = middle(mesh.cells[cell], faces_of(mesh.cells[cell].type)[side]) / scale_;
  }
  void throw_if_any(const std::string& what) const {
    if (count_ == 0) return;
    throw UserError("{}: {} (faces: {}; the first at ({:.6g}, {:.6g}, {:.6g}), cell {})", file_, what, count_, place_.x(),
                    place_.y(), place_.z(), cell_);
  }

 private:
  const std::string& file_;
  double scale_;
  PetscInt count_ = 0;
  Index cell_ = 0;
  Vec3 place_ = Vec3::Zero();
};

FaceVertices sorted_vertices(const FileCell& cell, const ShapeFace& face) {
  FaceVertices v{-1, -1, -1, -1};
  for (int i = 0; i < face.n; ++i) v[i] = cell.corners[face.point[i]].node;
  std::sort(v.begin(), v.end());
  return v;
}

std::vector<SharedFace> plex_faces(DM dm, PetscInt begin, PetscInt end) {
  std::vector<SharedFace> faces(end - begin);
  const std::vector<PetscInt> tags = physical_tags(dm, "Face Sets", begin, end);
  PetscInt first_vertex = 0, end_vertex = 0;
  petsc(DMPlexGetDepthStratum(dm, 0, &first_vertex, &end_vertex));
  for (PetscInt f = begin; f < end; ++f) {
    SharedFace& face = faces[f - begin];
    face.tag = tags[f - begin];
    face.vertices.fill(-1);
    PetscInt n_closure = 0, n = 0;
    PetscInt* closure = nullptr;
    petsc(DMPlexGetTransitiveClosure(dm, f, PETSC_TRUE, &n_closure, &closure));
    for (PetscInt i = 0; i < n_closure; ++i)
      if (const PetscInt p = closure[2 * i]; p >= first_vertex && p < end_vertex) face.vertices[n++] = p - first_vertex;
    petsc(DMPlexRestoreTransitiveClosure(dm, f, PETSC_TRUE, &n_closure, &closure));
    std::sort(face.vertices.begin(), face.vertices.end());
  }
  return faces;
}

/// Faces of the cells, found among Plex's faces of the same cell by their vertices.
std::vector<SharedFace> shared_faces(DM dm, const FileMesh& mesh, Complaint& crowded) {
  PetscInt begin = 0, end = 0;
  petsc(DMPlexGetHeightStratum(dm, 1, &begin, &end));
  std::vector<SharedFace> faces = plex_faces(dm, begin, end);
  for (Index c = 0; c < static_cast<Index>(mesh.cells.size()); ++c) {
    const PetscInt* cone = nullptr;
    petsc(DMPlexGetCone(dm, c, &cone));
    const auto shapes = faces_of(mesh.cells[c].type);
    for (int s = 0; s < static_cast<int>(shapes.size()); ++s) {
      const FaceVertices vertices = sorted_vertices(mesh.cells[c], shapes[s]);
      const auto* found = std::find_if(cone, cone + shapes.size(),
                                       [&](PetscInt f) { return faces[f - begin].vertices == vertices; });
      if (found == cone + shapes.size() || faces[*found - begin].uses == 2) {
        crowded.add(mesh, c, s);
        continue;
      }
      SharedFace& face = faces[*found - begin];
      face.cell[face.uses] = c;
      face.side[face.uses++] = s;
    }
  }
  return faces;
}

/// From the image of the face at its first cell to the one at its second; false if that is no translation.
bool translation(const FileMesh& mesh, const SharedFace& face, Vec3& shift) {
  const FileCell &a = mesh.cells[face.cell[0]], &b = mesh.cells[face.cell[1]];
  const ShapeFace &at = faces_of(a.type)[face.side[0]], &bt = faces_of(b.type)[face.side[1]];
  shift = middle(b, bt) - middle(a, at);
  double size = 0, mismatch = 0;
  bool same = true;
  for (int i = 0; i < at.n; ++i)
    for (int j = 0; j < bt.n; ++j) {
      const FileCorner &p = a.corners[at.point[i]], &q = b.corners[bt.point[j]];
      size = std::max(size, (p.position - a.corners[at.point[0]].position).norm());
      if (p.node != q.node) continue;
      same = same && p.position == q.position;
      mismatch = std::max(mismatch, (q.position - p.position - shift).norm());
    }
  if (same) shift.setZero();
  return mismatch <= 1e-6 * size;
}

bool is_inverted(const FileCell& cell) {
  std::array<Vec3, 8> corners;
  for (int i = 0; i < point_count(cell.type); ++i) corners[i] = cell.corners[i].position;
  return cell_geometry(cell.type, std::span(corners).first(point_count(cell.type))).volume <= 0;
}

/// Whether the two cells lie on the same side of their face: they run round it in the same direction. (So they do when one
/// is inverted, which is another complaint.)
bool overlap(const FileMesh& mesh, const SharedFace& face) {
  const FileCell &a = mesh.cells[face.cell[0]], &b = mesh.cells[face.cell[1]];
  const ShapeFace &at = faces_of(a.type)[face.side[0]], &bt = faces_of(b.type)[face.side[1]];
  const auto node_a = [&](int i) { return a.corners[at.point[i % at.n]].node; };
  const auto node_b = [&](int i) { return b.corners[bt.point[i % bt.n]].node; };
  int first = 0;
  while (node_b(first) != node_a(0)) ++first;
  return node_b(first + 1) != node_a(at.n - 1) && !is_inverted(a) && !is_inverted(b);
}

/// Periodic surfaces of which only the edges were matched (gmsh without its search for closest nodes leaves such files):
/// there more than two boundary faces meet at an edge. Adds one of them for each such edge.
void find_half_matched(DM dm, const FileMesh& mesh, const std::vector<SharedFace>& faces, Complaint& complaint) {
  Vec periodic = nullptr;
  petsc(DMGetCellCoordinatesLocal(dm, &periodic));
  if (!periodic) return;
  PetscInt first_face = 0, begin = 0, end = 0;
  petsc(DMPlexGetHeightStratum(dm, 1, &first_face, nullptr));
  petsc(DMPlexGetDepthStratum(dm, 1, &begin, &end));
  for (PetscInt edge = begin; edge < end; ++edge) {
    PetscInt n = 0;
    const PetscInt* around = nullptr;
    petsc(DMPlexGetSupportSize(dm, edge, &n));
    petsc(DMPlexGetSupport(dm, edge, &around));
    const auto on_boundary = [&](PetscInt f) { return faces[f - first_face].uses == 1; };
    if (std::count_if(around, around + n, on_boundary) <= 2) continue;
    const SharedFace& face = faces[*std::find_if(around, around + n, on_boundary) - first_face];
    complaint.add(mesh, face.cell[0], face.side[0]);
  }
}

class PatchList {
 public:
  explicit PatchList(const GmshHeader& header) : header_(header) {}
  void add(PetscInt tag, int zone) { index_[{tag, zone}] = 0; }
  std::vector<PatchName> names() {
    std::vector<PatchName> names;
    for (auto& [key, index] : index_) {
      index = static_cast<int>(names.size());
      names.push_back({header_.name_of(2, key.first), key.second});
    }
    return names;
  }
  int find(PetscInt tag, int zone) const { return index_.at({tag, zone}); }

 private:
  const GmshHeader& header_;
  std::map<std::pair<PetscInt, int>, int> index_;  // by tag, then zone
};

}  // namespace

void pair_faces(DM dm, const GmshHeader& header, const std::string& file, double scale, FileMesh& mesh) {
  Complaint crowded(file, scale), half_matched(file, scale), holes(file, scale), unnamed(file, scale),
      inside(file, scale), turned(file, scale), overlapping(file, scale);
  const std::vector<SharedFace> faces = shared_faces(dm, mesh, crowded);
  crowded.throw_if_any("a face belongs to more than two cells: a cell is twice in the file, or there are less than three "
                       "cells between periodic surfaces");
  find_half_matched(dm, mesh, faces, half_matched);
  half_matched.throw_if_any("periodic surfaces are matched at their edges only: the program that made the mesh left out "
                            "the pairs of nodes inside");
  const auto zone_of = [&](const SharedFace& face, int k) { return mesh.cells[face.cell[k]].zone; };
  const auto interior = [&](const SharedFace& face) { return face.uses == 2 && zone_of(face, 0) == zone_of(face, 1); };
  PatchList patches(header);
  for (const SharedFace& face : faces) {
    if (face.uses == 2 && overlap(mesh, face)) overlapping.add(mesh, face.cell[0], face.side[0]);
    if (interior(face)) {
      Vec3 shift;
      if (!translation(mesh, face, shift)) turned.add(mesh, face.cell[0], face.side[0]);
      if (face.tag != 0 && shift.isZero(0)) inside.add(mesh, face.cell[0], face.side[0]);
    } else if (face.tag == 0) {
      (face.uses == 1 ? holes : unnamed).add(mesh, face.cell[0], face.side[0]);
    } else {
      for (int k = 0; k < face.uses; ++k) patches.add(face.tag, zone_of(face, k));
    }
  }
  overlapping.throw_if_any("cells overlap: two of them lie on the same side of their common face");
  turned.throw_if_any("periodic surfaces are not translations of each other, or less than three cells apart");
  holes.throw_if_any("a hole: boundary faces without physical surface; put every boundary surface into one");
  unnamed.throw_if_any("faces between two physical volumes without physical surface; name the surface, or put both "
                       "volumes into one");
  inside.throw_if_any("a physical surface inside a physical volume; walls have two sides: cut the volume there");

  mesh.patches = patches.names();
  for (const SharedFace& face : faces)
    for (int k = 0; k < face.uses; ++k) {
      FileSide& side = mesh.cells[face.cell[k]].sides[face.side[k]];
      if (interior(face)) {
        side.neighbour = face.cell[1 - k];
        side.neighbour_side = face.side[1 - k];
      } else {
        side.patch = patches.find(face.tag, zone_of(face, k));
      }
    }
}

void number_corners(FileMesh& mesh) {
  PetscInt n_vertices = 0;
  for (const FileCell& cell : mesh.cells)
    for (int i = 0; i < point_count(cell.type); ++i) n_vertices = std::max(n_vertices, cell.corners[i].node + 1);
  std::vector<PetscInt> node_of(n_vertices * mesh.zones.size(), -1);
  std::vector<PetscInt> first_point, next_point;  // the points of each node, chained
  std::vector<const Vec3*> position;
  for (FileCell& cell : mesh.cells)
    for (int i = 0; i < point_count(cell.type); ++i) {
      FileCorner& corner = cell.corners[i];
      PetscInt& node = node_of[corner.node * mesh.zones.size() + cell.zone];
      if (node < 0) {
        node = static_cast<PetscInt>(first_point.size());
        first_point.push_back(-1);
      }
      corner.node = node;
      PetscInt p = first_point[corner.node];
      while (p >= 0 && *position[p] != corner.position) p = next_point[p];
      if (p < 0) {
        p = static_cast<PetscInt>(position.size());
        position.push_back(&corner.position);
        next_point.push_back(first_point[corner.node]);
        first_point[corner.node] = p;
      }
      corner.point = p;
    }
}

}  // namespace windhover::mesh
