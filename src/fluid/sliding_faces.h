// The faces between zones that slide on each other: made anew for every angle from the exact pieces of the interfaces.
#pragma once
#include <deque>
#include <vector>

#include "fluid/face_kernel.h"
#include "mesh/mesh.h"
#include "mesh/motion.h"
#include "mesh/remote_rows.h"
#include "mesh/sliding/sliding_interface.h"

namespace windhover::fluid {

/// Frames of all zones at one time.
using Frames = std::vector<mesh::FrameState>;
template <class Number>
using InterfaceFacesOf = std::vector<mesh::FaceBlockOf<Number>>;
using InterfaceFaces = InterfaceFacesOf<double>;

/// Cells of other ranks that own ones meet at an interface are kept after the mesh's own cells, as rows from mesh.n_cells on: at
/// every angle others, in the order of their ranks and numbers.
class SlidingFaces {
 public:
  SlidingFaces(const mesh::Mesh& mesh, std::vector<mesh::SlidingInterface> interfaces);

  /// Rows of cells, with all that may be met at some angle.
  mesh::Index n_cells() const { return mesh_.n_cells + static_cast<mesh::Index>(peer_.size()); }
  bool empty() const { return interfaces_.empty(); }
  size_t size() const { return interfaces_.size(); }
  /// Whether a patch of the mesh lies on an interface (and so has no boundary condition).
  bool covers(int patch) const;
  /// The zone whose frame the blocks of an interface are in.
  int frame_zone(size_t i) const { return interfaces_[i].zone(1); }
  /// The zones of cell[0] and cell[1] of its blocks.
  std::array<int, 2> zones(size_t i) const { return {interfaces_[i].zone(0), interfaces_[i].zone(1)}; }
  /// This rank's cells at an interface, in ascending order.
  const std::vector<mesh::Index>& own_cells() const { return own_; }
  /// Where among them an owned cell is; −1 for one that is away from all interfaces.
  const std::vector<mesh::Index>& place() const { return place_; }

  /// Of each interface at these frames the faces that have a cell on this rank, in the parent's frame, normals from the inner
  /// zone (cell[0]) to the parent. Collective; SolverFailure when the pieces do not sum to the faces (audit).
  /// Number is double or float.
  template <class Number = double>
  const std::vector<InterfaceFacesOf<Number>>& faces(const Frames& frames) {
    if constexpr (std::is_same_v<Number, float>)
      return single(position(frames));
    else
      return position(frames).faces;
  }

  /// Exchanges the rows of other ranks' cells that those faces have. Collective; valid until faces or others of different frames are asked for.
  mesh::RemoteRows& others(const Frames& frames) { return position(frames).others; }

 private:
  struct Position {
    std::vector<double> angles;
    std::vector<InterfaceFaces> faces;
    std::vector<InterfaceFacesOf<float>> single;  ///< empty until they are asked for
    std::vector<mesh::Index> row;                 ///< of each other rank's cell; unmet ones have none
    mesh::RemoteRows others;
  };
  Position& position(const Frames& frames);
  static const std::vector<InterfaceFacesOf<float>>& single(Position& p);
  void number_cells();
  double angle(const mesh::SlidingInterface& interface, const Frames& frames) const;
  /// Of one interface at its present angle.
  typedef std::vector<mesh::Piece> Pieces;
  void choose_rows(const std::vector<const Pieces*>& pieces, Position& position) const;
  void make_faces(size_t i, const Pieces& pieces, Position& position) const;

  const mesh::Mesh& mesh_;
  int rank_;
  std::vector<mesh::SlidingInterface> interfaces_;
  std::vector<std::array<std::vector<mesh::Index>, 2>>
      face_cell_;  ///< of each face its own cell, or mesh.n_cells and which of the others; −1 on ranks away from the interface
  std::vector<mesh::Index> own_, place_;  ///< see own_cells() and place()
  std::vector<int> ranks_;                ///< that have cells at this rank's interfaces
  std::vector<mesh::Index> others_end_;   ///< of each one's cells among the others, which are in the order of ranks and numbers
  std::vector<int> peer_;                 ///< of each of the others its rank's place in ranks_
  std::deque<Position> positions_;  ///< the latest ones: a step works at its two ends
};

}  // namespace windhover::fluid
