// Sliding interfaces: the exact pieces in which the faces of a turning zone meet those of its parent.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "mesh/sliding/box_tree.h"
#include "mesh/sliding/side.h"

namespace windhover::mesh {

/// Γ, and the two patches of the mesh that cover it, one from inside and one from outside.
struct SlidingPair {
  SlidingSurface surface;  ///< in the mesh's lengths; zones are at rest at angle 0 in the mesh
  int inner_patch = 0, outer_patch = 0;
};

/// Where one face of the inner zone and one of the parent meet. All but arm[0] in the parent's frame.
struct Piece {
  int inner = 0, outer = 0;    ///< faces of the two sides
  Vec3 area = Vec3::Zero();    ///< ∫ n dA, n from the inner zone to the parent
  Vec3 moment = Vec3::Zero();  ///< ∫ r × n dA about the parent's origin
  Vec3 centroid = Vec3::Zero();
  std::array<Vec3, 2> arm;  ///< centroid minus that of the cell: inner in the inner zone's frame, outer in the parent's
};

class SlidingInterface {
 public:
  /// Sides 0 (inner) and 1 (outer), known to all ranks.
  SlidingInterface(const RevolutionSurface& surface, std::array<InterfaceSide, 2> sides, MPI_Comm comm);

  const std::vector<InterfaceFace>& faces(int side) const { return sides_[side].faces; }
  int patch(int side) const { return sides_[side].patch; }
  int zone(int side) const { return sides_[side].zone; }
  Vec3 axis() const { return surface_.axes().col(2); }  ///< in the parent's frame

  /// Cuts pieces with the inner zone turned by the angle about the axis (right-handed, radians, relative to the parent): on each
  /// rank those of an equal share of the inner faces, whosever they are. The sum over a face's pieces is the face. The same
  /// normal velocity of the mesh on both sides: n·(axis × r) = 0. Waits for no other rank, so that what ranks need for several
  /// interfaces can even out before they are handed out.
  void cut(double angle) const;
  /// The pieces cut last with at least one cell on this rank, ordered by inner, then outer face. Valid until the next cut.
  /// Collective.
  const std::vector<Piece>& hand_out() const;
  const std::vector<Piece>& pieces(double angle) const {
    cut(angle);
    return hand_out();
  }

  /// Collective: the largest |Σ pieces − face| over both sides, in area relative to the face's size, and in moment to size
  /// times distance. SolverFailure above 1e-10.
  double audit(double angle, std::span<const Piece> pieces) const;

 private:
  int first_of_share(int rank) const;

  RevolutionSurface surface_;
  std::array<InterfaceSide, 2> sides_;
  BoxTree outer_boxes_;
  std::vector<Box> outer_in_chart_;
  std::vector<long> work_before_;
  MPI_Comm comm_;
  int rank_;
  mutable std::vector<Piece> share_, sent_, received_;  ///< some MB that are kept from call to call
  mutable std::vector<std::array<int, 2>> owners_;      ///< ranks of the two faces of each piece of share_
};

/// Collective, once after read_mesh, for all interfaces of the mesh together: finds and checks their faces, and gives the
/// mesh its exact curved geometry there (see curve_mesh). UserError with a place in lengths divided by `scale`.
std::vector<SlidingInterface> make_sliding_interfaces(Mesh& mesh, std::span<const SlidingPair> pairs, double scale);

}  // namespace windhover::mesh
