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
  const mesh::Mat3& forth(size_t zone) const { return turn_[zone]; }
  const mesh::Mat3& back(size_t zone) const { return back_[zone]; }
  /// Conserved variables, five per owned cell: momenta turn with their zones.
  void forth(const mesh::Mesh& mesh, Vec q) const { turn(mesh, turn_, q); }
  void back(const mesh::Mesh& mesh, Vec q) const { turn(mesh, back_, q); }
  void forth(const mesh::Mesh& mesh, float* q) const { turn(mesh, turn_, q); }
  void back(const mesh::Mesh& mesh, float* q) const { turn(mesh, back_, q); }

 private:
  static void turn(const mesh::Mesh& mesh, const std::vector<mesh::Mat3>& turns, Vec q);
  template <class Number>
  static void turn(const mesh::Mesh& mesh, const std::vector<mesh::Mat3>& turns, Number* q);

  bool none_ = true;
  std::vector<mesh::Mat3> turn_, back_;
};

}  // namespace windhover::fluid
