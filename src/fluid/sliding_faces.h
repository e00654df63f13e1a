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

/// Cells of other ranks at an interface are kept after the mesh's own cells, as rows [mesh.n_cells, n_cells()): every
/// rank that has cells at an interface keeps all the others there, since they may meet at some angle, in the
/// order of their ranks and numbers.
class SlidingFaces {
 public:
  SlidingFaces(const mesh::Mesh& mesh, std::vector<mesh::SlidingInterface> interfaces);

  mesh::Index n_cells() const { return n_cells_; }
  bool empty() const { return interfaces_.empty(); }
  size_t size() const { return interfaces_.size(); }
  /// Whether a patch of the mesh lies on an interface (and so has no boundary condition).
  bool covers(int patch) const;
  /// The zone whose frame the blocks of an interface are in.
  int frame_zone(size_t i) const { return interfaces_[i].zone(1); }
  /// The zones of cell[0] and cell[1] of its blocks.
  std::array<int, 2> zones(size_t i) const { return {interfaces_[i].zone(0), interfaces_[i].zone(1)}; }
  /// This rank's cells at an interface, in ascending order.
  std::vector<mesh::Index> own_cells() const;

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

  /// Fills the rows of other ranks' cells; between begin and end none of an interface's rows may change. Collective.
  template <class Row>
  void begin_exchange(Row* rows) const {
    remote_.begin(rows);
  }
  template <class Row>
  void end_exchange(Row* rows) const {
    remote_.end(rows);
  }

 private:
  struct Position {
    std::vector<double> angles;
    std::vector<InterfaceFaces> faces;
    std::vector<InterfaceFacesOf<float>> single;  ///< empty until they are asked for
  };
  Position& position(const Frames& frames);
  static const std::vector<InterfaceFacesOf<float>>& single(Position& p);
  void number_cells();
  double angle(const mesh::SlidingInterface& interface, const Frames& frames) const;
  void make_faces(size_t i, const std::vector<mesh::Piece>& pieces, InterfaceFaces& faces) const;

  const mesh::Mesh& mesh_;
  int rank_;
  std::vector<mesh::SlidingInterface> interfaces_;
  mesh::Index n_cells_;
  std::vector<std::array<std::vector<int>, 2>>
      face_cell_;  ///< row of each face's cell; −1 on ranks away from the interface
  mutable mesh::RemoteRows remote_;
  std::deque<Position> positions_;  ///< the latest ones: a step works at its two ends
};

}  // namespace windhover::fluid
