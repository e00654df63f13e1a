#include "mesh/sliding/side.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <tuple>

#include "base/collective.h"
#include "mesh/cell_shape.h"

namespace windhover::mesh {
namespace {

/// Sent between ranks as bytes; corners as its cell sees them.
struct RawFace {
  PetscInt file_cell = 0;
  int side = 0, rank = 0;
  Index cell = 0;
  int n = 0;
  double corner[4][3] = {};
  std::uint64_t place = 0;  ///< along a curve that fills space, so that faces near each other are near in memory
  auto order() const { return std::tuple(place, file_cell, side); }
};

/// Morton's curve through the cube of edge 4 · size about the origin.
std::uint64_t place_on_curve(const Vec3& r, double size) {
  std::uint64_t place = 0;
  for (int d = 0; d < 3; ++d) {
    const auto along = static_cast<std::uint64_t>(std::clamp((r[d] / size + 2) / 4, 0.0, 1.0) * 0xFFFFF);
    for (int bit = 0; bit < 20; ++bit) place |= (along >> bit & 1) << (3 * bit + d);
  }
  return place;
}

std::vector<RawFace> own_faces(const Mesh& mesh, const RevolutionSurface& surface, int patch) {
  std::vector<RawFace> faces;
  for (const FaceBlock& block : mesh.patches[patch].blocks)
    for (int lane = 0; lane < block.count; ++lane) {
      const Index cell = block.cell[0][lane];
      const ShapeFace& shape = faces_of(mesh.type[cell])[block.side[lane]];
      RawFace face{mesh.file_cell[cell], block.side[lane], rank_of(mesh.comm), cell, shape.n};
      for (int k = 0; k < shape.n; ++k)
        Eigen::Map<Vec3>(face.corner[k]) = mesh.point[mesh.cell_point[mesh.cell_point_start[cell] + shape.point[k]]];
      face.place = place_on_curve(surface.to_local(Eigen::Map<Vec3>(face.corner[0])), surface.reach());
      faces.push_back(face);
    }
  return faces;
}

std::vector<RawFace> gather(const std::vector<RawFace>& own, MPI_Comm comm) {
  const int n_ranks = size_of(comm), bytes = static_cast<int>(own.size() * sizeof(RawFace));
  std::vector<int> count(n_ranks), start(n_ranks + 1, 0);
  MPI_Allgather(&bytes, 1, MPI_INT, count.data(), 1, MPI_INT, comm);
  for (int r = 0; r < n_ranks; ++r) start[r + 1] = start[r] + count[r];
  std::vector<RawFace> all(start[n_ranks] / sizeof(RawFace));
  MPI_Allgatherv(own.data(), bytes, MPI_BYTE, all.data(), count.data(), start.data(), MPI_BYTE, comm);
  std::sort(all.begin(), all.end(), [](const RawFace& a, const RawFace& b) { return a.order() < b.order(); });
  return all;
}

const char* name_of(Part part) {
  switch (part) {
    case Part::wall: return "wall";
    case Part::bottom: return "lower disc";
    case Part::top: return "upper disc";
    case Part::sphere: return "sphere";
  }
  return "";
}

class SideBuilder {
 public:
  SideBuilder(const Mesh& mesh, const RevolutionSurface& surface, int patch, bool inner, double scale)
      : surface_(surface), scale_(scale), patch_name_(mesh.patches[patch].name) {
    side_.patch = patch;
    side_.zone = mesh.patches[patch].zone;
    side_.inner = inner;
    zone_name_ = mesh.zones[side_.zone].name;
  }

  InterfaceSide build(const std::vector<RawFace>& raw) {
    number_nodes(raw);
    place_nodes();
    for (std::size_t f = 0; f < side_.faces.size(); ++f) parts_.push_back(part_of(side_.corner_node[f]));
    pair_edges();
    for (std::size_t f = 0; f < side_.faces.size(); ++f) make_face(f);
    check_areas();
    return std::move(side_);
  }

 private:
  template <class... Args>
  [[noreturn]] void fail(const Vec3& place, fmt::format_string<Args...> format, Args&&... args) const {
    const Vec3 p = place / scale_;
    throw UserError("sliding interface, surface '{}' of zone '{}': {} at ({:.6g}, {:.6g}, {:.6g})", patch_name_,
                    zone_name_, fmt::format(format, std::forward<Args>(args)...), p.x(), p.y(), p.z());
  }
  Vec3 middle(int f) const {
    const InterfaceFace& face = side_.faces[f];
    Vec3 sum = Vec3::Zero();
    for (int k = 0; k < face.n; ++k) sum += side_.node_in_file[side_.corner_node[f][k]];
    return sum / face.n;
  }

  void number_nodes(const std::vector<RawFace>& raw) {
    std::map<std::array<double, 3>, int> number;
    for (const RawFace& r : raw) {
      InterfaceFace& face = side_.faces.emplace_back();
      face.rank = r.rank, face.cell = r.cell, face.n = r.n;
      auto& nodes = side_.corner_node.emplace_back();
      nodes.fill(-1);
      for (int k = 0; k < r.n; ++k) {
        const double* p = r.corner[side_.inner ? k : r.n - 1 - k];  // from outside of Γ, not of the cell
        const auto [found, is_new] = number.try_emplace({p[0], p[1], p[2]}, static_cast<int>(number.size()));
        nodes[k] = found->second;
        if (is_new) side_.node_in_file.emplace_back(p[0], p[1], p[2]);
      }
    }
  }

  void place_nodes() {
    std::size_t worst = 0, n_off = 0;
    for (const Vec3& r : side_.node_in_file) {
      places_.push_back(surface_.place(surface_.to_local(r)));
      side_.node.push_back(surface_.to_parent(places_.back().position));
      if (places_.back().distance > surface_.tolerance()) ++n_off;
      if (places_.back().distance > places_[worst].distance) worst = places_.size() - 1;
    }
    if (n_off > 0)
      fail(side_.node_in_file[worst], "{} of {} nodes are not on the {} of radius {:.6g}; the worst is {:.3g} off",
           n_off, places_.size(), surface_.is_sphere() ? "sphere" : "cylinder", surface_.radius() / scale_,
           places_[worst].distance / scale_);
  }

  /// All nodes of a face on a disc may lie on its rim: then it belongs to the disc, for a wall's face has some height.
  Part part_of(const std::array<int, 4>& nodes) const {
    unsigned common = ~0U;
    for (const int node : nodes)
      if (node >= 0) common &= places_[node].parts;
    for (const Part part : {Part::bottom, Part::top, Part::wall, Part::sphere})
      if (common & bit(part)) return part;
    fail(side_.node_in_file[nodes[0]], "a face crosses the cylinder's rim");
  }

  /// A closed surface has each edge twice, once in each direction. Arcs of the rim are edges of faces of the wall.
  void pair_edges() {
    std::set<std::pair<int, int>> edges;
    for (std::size_t f = 0; f < side_.faces.size(); ++f)
      for_each_edge(f, [&](int a, int b) {
        if (!edges.emplace(a, b).second) fail(side_.node_in_file[a], "faces overlap or are turned inside out");
        if (parts_[f] == Part::wall) wall_edges_.emplace(a, b);
      });
    for (const auto& [a, b] : edges)
      if (!edges.contains({b, a}))
        fail(side_.node_in_file[a], "the surface has a gap: an edge belongs to one face only");
  }
  template <class Visit>
  void for_each_edge(std::size_t f, Visit&& visit) const {
    const int n = side_.faces[f].n;
    for (int k = 0; k < n; ++k) visit(side_.corner_node[f][k], side_.corner_node[f][(k + 1) % n]);
  }

  void make_face(std::size_t f) {
    InterfaceFace& face = side_.faces[f];
    const Chart chart{&surface_, parts_[f]};
    std::array<Vec3, 4> local;
    for (int k = 0; k < face.n; ++k) {
      const int node = side_.corner_node[f][k];
      local[k] = places_[node].position;
      face.corner[k] = side_.node[node];
    }
    bool arc[4] = {};
    int edge = 0;
    for_each_edge(f, [&](int a, int b) { arc[edge++] = parts_[f] != Part::wall && wall_edges_.contains({b, a}); });
    check_span(f, local);
    const ChartFace& placed =
        side_.charts.emplace_back(chart_face(chart, std::span(local).first(face.n), std::span(arc).first(face.n)));
    check_convex(f, placed);
    const PatchIntegrals integrals = integrate(chart, placed.outline, placed.rim);
    face.size = integrals.size;
    face.area = surface_.axes() * integrals.area;
    face.moment = surface_.axes() * integrals.moment + surface_.origin().cross(face.area);
    face.centroid = surface_.to_parent(integrals.centroid);
    areas_[parts_[f]] += face.size;
  }

  /// A curved face must span clearly less than half a turn: beyond, its edges are no longer the short way round.
  void check_span(std::size_t f, const std::array<Vec3, 4>& local) const {
    constexpr double largest = 2.2;  // radians; three faces around are allowed
    if (parts_[f] == Part::bottom || parts_[f] == Part::top) return;
    const int height = surface_.is_sphere() ? 3 : 2;
    for (int i = 0; i < side_.faces[f].n; ++i)
      for (int j = 0; j < i; ++j) {
        const double cosine =
            local[i].head(height).dot(local[j].head(height)) / (surface_.radius() * surface_.radius());
        if (cosine < std::cos(largest))
          fail(middle(f), "the mesh is too coarse: a face spans more than {} rad", largest);
      }
  }

  void check_convex(std::size_t f, const ChartFace& face) const {
    const Outline& p = face.outline;
    for (int k = 0; k < p.n; ++k) {
      const Vec3 &a = p.v[k], &b = p.v[(k + 1) % p.n], &c = p.v[(k + 2) % p.n];
      const double turn = ChartLine::through(a, b).side(c);
      if (turn < -1e-10 * (b - a).norm() * (c - b).norm())
        fail(middle(f), "a face is not convex on the surface, or inside out (are the two zones exchanged?)");
    }
  }

  void check_areas() const {
    using enum Part;
    for (const Part part : surface_.is_sphere() ? std::vector{sphere} : std::vector{wall, bottom, top}) {
      const double area = areas_.contains(part) ? areas_.at(part) : 0, exact = surface_.area(part);
      if (std::abs(area - exact) > 1e-10 * exact)
        fail(surface_.origin(), "gap or overlap: the faces cover {:.12g} of the area {:.12g} of the {}",
             area / (scale_ * scale_), exact / (scale_ * scale_),
             name_of(part));
    }
  }

  const RevolutionSurface& surface_;
  double scale_;
  std::string patch_name_, zone_name_;
  InterfaceSide side_;
  std::vector<Place> places_;
  std::vector<Part> parts_;
  std::set<std::pair<int, int>> wall_edges_;
  std::map<Part, double> areas_;
};

}  // namespace

InterfaceSide gather_side(const Mesh& mesh, const RevolutionSurface& surface, int patch, bool inner, double scale) {
  const std::vector<RawFace> raw = gather(own_faces(mesh, surface, patch), mesh.comm);
  return SideBuilder(mesh, surface, patch, inner, scale).build(raw);
}

}  // namespace windhover::mesh
