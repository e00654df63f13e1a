#include "mesh/sliding/sliding_interface.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/collective.h"
#include "base/mpi_type.h"
#include "mesh/sliding/check_zones.h"
#include "mesh/sliding/curve_mesh.h"

namespace windhover::mesh {
namespace {

/// Contains the patch of Γ: that is never farther from its corners' hull than their distance squared over the radius.
Box box_of(const RevolutionSurface& surface, const std::array<Vec3, 4>& local, int n) {
  Box box;
  for (int k = 0; k < n; ++k) box.extend(local[k]);
  const double reach = box.diagonal().squaredNorm() / surface.radius();
  return {box.min().array() - reach, box.max().array() + reach};
}

std::array<Vec3, 4> local_corners(const RevolutionSurface& surface, const InterfaceFace& face) {
  std::array<Vec3, 4> local;
  for (int k = 0; k < face.n; ++k) local[k] = surface.to_local(face.corner[k]);
  return local;
}

/// For each inner face and the end: what cutting all faces before it takes, in other faces that their boxes meet.
std::vector<long> work_before(const RevolutionSurface& surface, const InterfaceSide& inner, const BoxTree& outer) {
  std::vector<long> work{0};
  std::vector<int> near;
  for (const InterfaceFace& face : inner.faces) {
    outer.find(box_of(surface, local_corners(surface, face), face.n), near);
    work.push_back(work.back() + 1 + static_cast<long>(near.size()));
  }
  return work;
}

BoxTree tree_of(const RevolutionSurface& surface, const InterfaceSide& side) {
  std::vector<Box> boxes;
  for (const InterfaceFace& face : side.faces) boxes.push_back(box_of(surface, local_corners(surface, face), face.n));
  return BoxTree(boxes);
}

Vec3 rotated(const Vec3& p, double cosine, double sine) {
  return {cosine * p.x() - sine * p.y(), sine * p.x() + cosine * p.y(), p.z()};
}

/// The outline of an inner face when its zone has turned.
Polygon turned(const ChartFace& face, const Chart& chart, double angle, double cosine, double sine) {
  Polygon polygon;
  for (const Vec3& p : std::span<const Vec3>(face.outline))
    polygon.add(face.part == Part::wall ? Vec3(p.x() + angle, p.y(), p.z()) : rotated(p, cosine, chart.mirror() * sine));
  return polygon;
}

/// Contains the face in its chart; nothing on a sphere, whose edges bulge.
Box box_in_chart(std::span<const Vec3> outline) {
  Box box;
  for (const Vec3& p : outline) box.extend(p);
  return box;
}

/// The part of the turned inner face inside the outer one; both with their boxes in the chart.
void intersect(const Chart& chart, const Polygon& inner, const Box& inner_box, const ChartFace& outer, const Box& outer_box,
               Polygon& common) {
  double turns = 0;
  if (chart.part == Part::wall)  // the same turn of the angle for both
    turns = 2 * M_PI * std::round((outer_box.center().x() - inner_box.center().x()) / (2 * M_PI));
  common.n = 0;
  if (chart.part != Part::sphere)
    for (int d = 0; d < 2; ++d) {
      const double shift = d == 0 ? turns : 0;
      if (inner_box.min()[d] + shift > outer_box.max()[d] || inner_box.max()[d] + shift < outer_box.min()[d]) return;
    }
  common.assign(inner);
  for (int k = 0; turns != 0 && k < common.n; ++k) common.v[k].x() += turns;
  for (int k = 0; k < outer.n_lines && common.n > 0; ++k) clip(chart, common, outer.lines[k]);
}

}  // namespace

SlidingInterface::SlidingInterface(const RevolutionSurface& surface, std::array<InterfaceSide, 2> sides, MPI_Comm comm)
    : surface_(surface),
      sides_(std::move(sides)),
      outer_boxes_(tree_of(surface_, sides_[1])),
      work_before_(work_before(surface_, sides_[0], outer_boxes_)),
      comm_(comm),
      rank_(rank_of(comm)) {
  for (const ChartFace& face : sides_[1].charts) outer_in_chart_.push_back(box_in_chart(face.outline));
}

int SlidingInterface::first_of_share(int rank) const {
  const long before = work_before_.back() * rank / size_of(comm_);
  return static_cast<int>(std::lower_bound(work_before_.begin(), work_before_.end(), before) - work_before_.begin());
}

void SlidingInterface::cut(double angle) const {
  constexpr double least = 1e-14;  // of the smaller face: below is round-off of faces that only touch
  angle = std::remainder(angle, 2 * M_PI);
  const double cosine = std::cos(angle), sine = std::sin(angle);
  const auto& [inner, outer] = sides_;
  const int begin = first_of_share(rank_), end = first_of_share(rank_ + 1);
  share_.clear();
  owners_.clear();
  share_.reserve(6 * static_cast<std::size_t>(end - begin));
  std::vector<int> near;
  Polygon common;
  for (int i = begin; i < end; ++i) {
    const InterfaceFace& face = inner.faces[i];
    const ChartFace& placed = inner.charts[i];
    const Chart chart{&surface_, placed.part};
    const Polygon polygon = turned(placed, chart, angle, cosine, sine);
    const Box box = box_in_chart(polygon);
    std::array<Vec3, 4> corners = local_corners(surface_, face);
    for (int k = 0; k < face.n; ++k) corners[k] = rotated(corners[k], cosine, sine);
    outer_boxes_.find(box_of(surface_, corners, face.n), near);
    for (const int j : near) {
      const InterfaceFace& other = outer.faces[j];
      if (outer.charts[j].part != placed.part) continue;
      intersect(chart, polygon, box, outer.charts[j], outer_in_chart_[j], common);
      const PatchIntegrals patch = integrate(chart, common, placed.rim && outer.charts[j].rim);
      if (!(patch.size > least * std::min(face.size, other.size))) continue;
      Piece piece;
      piece.inner = i;
      piece.outer = j;
      piece.area = surface_.axes() * patch.area;
      piece.moment = surface_.axes() * patch.moment + surface_.origin().cross(piece.area);
      piece.centroid = surface_.to_parent(patch.centroid);
      piece.arm = {surface_.to_parent(rotated(patch.centroid, cosine, -sine)) - face.cell_centroid,
                   piece.centroid - other.cell_centroid};
      share_.push_back(piece);
      owners_.push_back({face.rank, other.rank});
    }
  }
}

const std::vector<Piece>& SlidingInterface::hand_out() const {
  const int ranks = size_of(comm_);
  if (ranks == 1) return share_;
  const auto for_each_receiver = [&](auto visit) {
    for (std::size_t k = 0; k < share_.size(); ++k) {
      const auto [inner, outer] = owners_[k];
      visit(k, inner);
      if (outer != inner) visit(k, outer);
    }
  };
  std::vector<int> n_sent(ranks), n_received(ranks), send_at(ranks), receive_at(ranks);
  for_each_receiver([&](std::size_t, int to) { ++n_sent[to]; });
  MPI_Alltoall(n_sent.data(), 1, MPI_INT, n_received.data(), 1, MPI_INT, comm_);
  received_.resize(std::accumulate(n_received.begin(), n_received.end(), 0));
  std::exclusive_scan(n_received.begin(), n_received.end(), receive_at.begin(), 0);  // by rank: in the order of the faces
  n_sent[rank_] = n_received[rank_] = 0;  // what stays here is copied
  sent_.resize(std::accumulate(n_sent.begin(), n_sent.end(), 0));
  std::exclusive_scan(n_sent.begin(), n_sent.end(), send_at.begin(), 0);
  std::vector<Piece*> next;
  for (int to = 0; to < ranks; ++to) next.push_back(to == rank_ ? received_.data() + receive_at[to] : sent_.data() + send_at[to]);
  for_each_receiver([&](std::size_t k, int to) { *next[to]++ = share_[k]; });
  const MpiType type(sizeof(Piece), MPI_BYTE);
  MPI_Alltoallv(sent_.data(), n_sent.data(), send_at.data(), type, received_.data(), n_received.data(), receive_at.data(),
                type, comm_);
  return received_;
}

double SlidingInterface::audit(double angle, std::span<const Piece> pieces) const {
  constexpr double allowed = 1e-10;
  std::array<std::vector<Vec3>, 2> area, moment;
  for (int side = 0; side < 2; ++side) area[side] = moment[side] = std::vector<Vec3>(faces(side).size(), Vec3::Zero());
  for (const Piece& piece : pieces)
    for (int side = 0; side < 2; ++side) {
      const int f = side == 0 ? piece.inner : piece.outer;
      area[side][f] += piece.area;
      moment[side][f] += piece.moment;
    }
  double worst = 0;
  Vec3 place = Vec3::Zero();
  const Mat3 turn = surface_.axes() * Eigen::AngleAxisd(angle, Vec3::UnitZ()) * surface_.axes().transpose();
  for (int side = 0; side < 2; ++side)
    for (std::size_t f = 0; f < faces(side).size(); ++f) {
      const InterfaceFace& face = faces(side)[f];
      if (face.rank != rank_) continue;
      const Vec3& o = surface_.origin();
      const Mat3 R = side == 0 ? turn : Mat3::Identity();
      const Vec3 turned_area = R * face.area,
                 turned_moment = R * (face.moment - o.cross(face.area)) + o.cross(turned_area);
      const double error = std::max((area[side][f] - turned_area).norm() / face.size,
                                    (moment[side][f] - turned_moment).norm() / (face.size * surface_.reach()));
      if (error <= worst) continue;
      worst = error;
      place = face.centroid;
    }
  struct {
    double error;
    int rank;
  } own{worst, rank_}, all{};
  MPI_Allreduce(&own, &all, 1, MPI_DOUBLE_INT, MPI_MAXLOC, comm_);
  if (all.error <= allowed) return all.error;
  MPI_Bcast(place.data(), 3, MPI_DOUBLE, all.rank, comm_);
  throw SolverFailure(
      "sliding interface: at ({:.6g}, {:.6g}, {:.6g}) in lengths of the mesh, the pieces of a face differ "
      "from it by {:.3g} of it",
      place.x(), place.y(), place.z(), all.error);
}

namespace {

/// Each rank knows the cells of its own faces.
void share_centroids(const Mesh& mesh, InterfaceSide& side) {
  std::vector<double> centroids(3 * side.faces.size());
  for (std::size_t f = 0; f < side.faces.size(); ++f)
    if (side.faces[f].rank == rank_of(mesh.comm))
      Vec3::Map(centroids.data() + 3 * f) = mesh.centroid[side.faces[f].cell];
  MPI_Allreduce(MPI_IN_PLACE, centroids.data(), static_cast<int>(centroids.size()), MPI_DOUBLE, MPI_SUM, mesh.comm);
  for (std::size_t f = 0; f < side.faces.size(); ++f) side.faces[f].cell_centroid = Vec3::Map(centroids.data() + 3 * f);
}

}  // namespace

std::vector<SlidingInterface> make_sliding_interfaces(Mesh& mesh, std::span<const SlidingPair> pairs, double scale) {
  std::vector<RevolutionSurface> surfaces;
  std::vector<std::array<InterfaceSide, 2>> sides;
  for (const SlidingPair& pair : pairs) {
    surfaces.emplace_back(pair.surface);
    sides.push_back({gather_side(mesh, surfaces.back(), pair.inner_patch, true, scale),
                     gather_side(mesh, surfaces.back(), pair.outer_patch, false, scale)});
  }
  check_zones(mesh, surfaces, sides, scale);
  std::vector<CurvedSide> curved;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    for (const InterfaceSide& side : sides[i]) curved.push_back({&surfaces[i], &side});
  curve_mesh(mesh, curved, scale);
  std::vector<SlidingInterface> interfaces;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    for (InterfaceSide& side : sides[i]) share_centroids(mesh, side);
    interfaces.emplace_back(surfaces[i], std::move(sides[i]), mesh.comm);
  }
  return interfaces;
}

}  // namespace windhover::mesh
