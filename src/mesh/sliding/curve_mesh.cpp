#include "mesh/sliding/curve_mesh.h"

#include <algorithm>
#include <map>
#include <unordered_map>

#include "base/collective.h"
#include "mesh/cell_shape.h"
#include "mesh/face_geometry.h"
#include "mesh/sliding/curved_face.h"

namespace windhover::mesh {
namespace {

using Nodes = std::array<int, 4>;

Nodes sorted(Nodes nodes) {
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

/// What is known of the nodes, edges and faces on all surfaces; nodes are numbered through all sides.
class Skin {
 public:
  explicit Skin(const std::vector<CurvedSide>& sides) : sides_(sides) {
    for (std::size_t s = 0; s < sides.size(); ++s) {
      const InterfaceSide& side = *sides[s].side;
      const int first = static_cast<int>(positions_.size());
      for (std::size_t i = 0; i < side.node.size(); ++i) {
        node_at_[key(side.zone, side.node_in_file[i])] = first + static_cast<int>(i);
        positions_.push_back(side.node[i]);
      }
      for (std::size_t f = 0; f < side.faces.size(); ++f) add_face(s, f, first);
    }
  }

  /// The node of a zone at a position as read; -1: none.
  int find_node(int zone, const Vec3& position) const {
    const auto found = node_at_.find(key(zone, position));
    return found == node_at_.end() ? -1 : found->second;
  }
  const Vec3& position(int node) const { return positions_[node]; }
  /// The surface that an edge follows; null: it is straight.
  const RevolutionSurface* curve(int a, int b) const {
    const auto found = curve_.find({std::min(a, b), std::max(a, b)});
    return found == curve_.end() ? nullptr : found->second;
  }
  struct Face {
    const CurvedSide* owner;
    std::size_t index;
    const InterfaceFace& face() const { return owner->side->faces[index]; }
    const ChartFace& chart() const { return owner->side->charts[index]; }
    double sign() const { return owner->side->inner ? 1 : -1; }  // of the cell's outward normal, against Γ's
    /// On a wall or a sphere n·(r − origin) is the radius.
    double volume(const Vec3& o) const {
      const RevolutionSurface& surface = *owner->surface;
      return sign() / 3 * (surface.radius() * face().size - (o - surface.origin()).dot(face().area));
    }
    Vec3 first(const Vec3& o) const { return sign() * patch_first({owner->surface, chart().part}, chart().outline, o); }
  };
  /// The face with these nodes; null: not on a surface.
  const Face* find_face(const Nodes& nodes) const {
    const auto found = faces_.find(sorted(nodes));
    return found == faces_.end() ? nullptr : &found->second;
  }

 private:
  using Key = std::array<double, 4>;
  static Key key(int zone, const Vec3& r) { return {static_cast<double>(zone), r.x(), r.y(), r.z()}; }

  void add_face(std::size_t s, std::size_t f, int first) {
    const InterfaceSide& side = *sides_[s].side;
    Nodes nodes = side.corner_node[f];
    for (int& node : nodes)
      if (node >= 0) node += first;
    faces_[sorted(nodes)] = {&sides_[s], f};
    const Part part = side.charts[f].part;
    if (part == Part::bottom || part == Part::top) return;
    const int n = side.faces[f].n;
    for (int k = 0; k < n; ++k) {
      const int a = nodes[k], b = nodes[(k + 1) % n];
      curve_[{std::min(a, b), std::max(a, b)}] = sides_[s].surface;
    }
  }

  const std::vector<CurvedSide>& sides_;
  std::map<Key, int> node_at_;
  std::vector<Vec3> positions_;
  std::map<std::pair<int, int>, const RevolutionSurface*> curve_;
  std::map<Nodes, Face> faces_;
};

class MeshCurver {
 public:
  MeshCurver(Mesh& mesh, const Skin& skin) : mesh_(mesh), skin_(skin), node_(mesh.point.size(), kUnknown) {}

  void run(double scale) {
    move_points();
    const std::vector<Vec3> old_centroid = mesh_.centroid;
    collectively(mesh_.comm, [&] {
      for (Index c = 0; c < mesh_.n_cells; ++c)
        if (touches(c)) correct_cell(c, scale);
    });
    for (FaceBlock& block : mesh_.faces) correct_block(block, old_centroid);
    for (Patch& patch : mesh_.patches)
      for (FaceBlock& block : patch.blocks) correct_block(block, old_centroid);
  }

 private:
  /// One face of a cell: its corners, and what of it lies on a surface.
  struct CellFace {
    int n = 0;
    std::array<Vec3, 4> r;
    Nodes node{-1, -1, -1, -1};
    std::array<const RevolutionSurface*, 4> curve{};
    const Skin::Face* on_surface = nullptr;
    bool touched = false, curved = false;
    std::span<const Vec3> positions() const { return std::span(r).first(n); }
  };

  void move_points() {
    for (Index c = 0; c < mesh_.n_cells; ++c)
      for (Index k = mesh_.cell_point_start[c]; k < mesh_.cell_point_start[c + 1]; ++k) {
        const Index point = mesh_.cell_point[k];
        if (node_[point] != kUnknown) continue;
        node_[point] = skin_.find_node(mesh_.cell_zone[c], mesh_.point[point]);
        if (node_[point] >= 0) mesh_.point[point] = skin_.position(node_[point]);
      }
  }

  bool touches(Index c) const {
    for (Index k = mesh_.cell_point_start[c]; k < mesh_.cell_point_start[c + 1]; ++k)
      if (node_[mesh_.cell_point[k]] >= 0) return true;
    return false;
  }

  CellFace face_of(Index c, int side) const {
    CellFace face;
    const ShapeFace& shape = faces_of(mesh_.type[c])[side];
    face.n = shape.n;
    int n_nodes = 0;
    for (int k = 0; k < shape.n; ++k) {
      const Index point = mesh_.cell_point[mesh_.cell_point_start[c] + shape.point[k]];
      face.r[k] = mesh_.point[point];
      face.node[k] = node_[point];
      if (node_[point] >= 0) ++n_nodes;
    }
    face.touched = n_nodes > 0;
    if (n_nodes == shape.n) face.on_surface = skin_.find_face(face.node);
    for (int k = 0; k < shape.n && n_nodes > 1; ++k) {
      face.curve[k] = skin_.curve(face.node[k], face.node[(k + 1) % shape.n]);
      face.curved = face.curved || face.curve[k];
    }
    return face;
  }

  /// By the divergence theorem over the cell's own faces, as every rank that knows the cell sees them.
  void correct_cell(Index c, double scale) {
    Vec3 o = Vec3::Zero();
    const Index begin = mesh_.cell_point_start[c], n = mesh_.cell_point_start[c + 1] - begin;
    for (Index k = 0; k < n; ++k) o += mesh_.point[mesh_.cell_point[begin + k]] / n;
    double volume = 0;
    Vec3 first = Vec3::Zero();
    const int n_faces = static_cast<int>(faces_of(mesh_.type[c]).size());
    for (int side = 0; side < n_faces; ++side) {
      const CellFace face = face_of(c, side);
      if (face.on_surface && is_curved(face.on_surface->chart().part)) {
        volume += face.on_surface->volume(o);
        first += face.on_surface->first(o);
      } else {
        const SurfaceSums sums = cone_sums(face.positions(), face.curve, o);
        volume += sums.volume;
        first += sums.first;
      }
    }
    if (!(volume > 0))
      throw UserError(
          "the mesh is too coarse at a sliding interface: with its curved edges, a cell of zone '{}' at "
          "({:.6g}, {:.6g}, {:.6g}) is turned inside out",
          mesh_.zones[mesh_.cell_zone[c]].name, o.x() / scale, o.y() / scale, o.z() / scale);
    mesh_.volume[c] = volume;
    mesh_.centroid[c] = o + first / volume;
  }
  static bool is_curved(Part part) { return part == Part::wall || part == Part::sphere; }

  FaceGeometry geometry(const CellFace& face) const {
    if (face.on_surface) {
      const double sign = face.on_surface->sign();
      const InterfaceFace& patch = face.on_surface->face();
      return {sign * patch.area, sign * patch.moment, patch.centroid};
    }
    if (!face.curved) return face_geometry(face.positions());
    const SurfaceSums sums = cone_sums(face.positions(), face.curve, face.r[0]);
    return {sums.area, sums.moment, sums.centroid / sums.size};
  }

  void correct_block(FaceBlock& block, const std::vector<Vec3>& old_centroid) const {
    for (int lane = 0; lane < block.count; ++lane) {
      Vec3 place[2];  // the face's centroid at each side: they differ by a translation where the mesh is periodic
      for (int side = 0; side < 2; ++side)
        place[side] = old_centroid[block.cell[side][lane]] + Eigen::Map<const Vec3>(block.arm[lane][side]);
      const CellFace face = face_of(block.cell[0][lane], block.side[lane]);
      if (face.touched) {
        const FaceGeometry g = geometry(face);
        for (int d = 0; d < 3; ++d) block.area[d][lane] = g.area[d], block.moment[d][lane] = g.moment[d];
        place[1] += g.centroid - place[0];
        place[0] = g.centroid;
      }
      for (int side = 0; side < 2; ++side) {
        const Index c = block.cell[side][lane];
        if (touches(c)) Eigen::Map<Vec3>(block.arm[lane][side]) = place[side] - mesh_.centroid[c];
      }
    }
  }

  static constexpr int kUnknown = -2;
  Mesh& mesh_;
  const Skin& skin_;
  std::vector<int> node_;  ///< of each point; -1: not on a surface
};

}  // namespace

void curve_mesh(Mesh& mesh, const std::vector<CurvedSide>& sides, double scale) {
  const Skin skin(sides);
  MeshCurver(mesh, skin).run(scale);
}

}  // namespace windhover::mesh
