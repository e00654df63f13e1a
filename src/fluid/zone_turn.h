// Momentum taken along with zones that turn.
#pragma once
#include <vector>

#include "fluid/sliding_faces.h"

namespace windhover::fluid {

/// By how much each zone has turned from one time to another.
class ZoneTurn {
 public:
  ZoneTurn() = default;
  ZoneTurn(const Frames& from, const Frames& to);

  /// No zone has.
  bool none() const { return none_; }
  /// Conserved variables, five per owned cell: `to` has the momenta of `from` turned with their zones; may be the same vector.
  void forth(const mesh::Mesh& mesh, Vec from, Vec to) const { turn(mesh, turn_, from, to); }
  void back(const mesh::Mesh& mesh, Vec from, Vec to) const { turn(mesh, back_, from, to); }

 private:
  static void turn(const mesh::Mesh& mesh, const std::vector<mesh::Mat3>& turns, Vec from, Vec to);

  bool none_ = true;
  std::vector<mesh::Mat3> turn_, back_;
};

}  // namespace windhover::fluid
