// The tree of zones of a case: which zone turns in which, and where all are at a time.
#pragma once
#include "app/scales.h"
#include "fluid/euler.h"

namespace windhover::app {

/// The mesh with its sliding interfaces; collective. UserError: a zone or surface that the mesh lacks, two zones claiming
/// one surface, zones that turn inside each other, and what the interfaces' own checks find.
struct ZonedMesh {
  mesh::Mesh mesh;
  std::vector<mesh::SlidingInterface> interfaces;
};
ZonedMesh read_zones(const Case& c, MPI_Comm comm);

/// Frames of all zones, nondimensional in and out.
class ZoneTree {
 public:
  ZoneTree(const Case& c, const mesh::Mesh& mesh);
  fluid::Frames frames(double time) const { return frames(body(time), time, {}); }

  /// Velocities of all frames are relative to air that wind.change moves, so that it moves the air everywhere alike.
  /// Angle (rad) and speed of a rotor of the body, about its spin axis.
  struct Spin {
    double angle, speed;
  };
  /// The same for a body that is elsewhere and whose rotors turn zones.
  fluid::Frames frames(const mesh::FrameState& body, double time, const std::vector<Spin>& spins) const;
  /// A point of the axis about which a zone turns, in the zone's own frame.
  Vec3 spin_point(int zone) const;

  mesh::FrameState body(double time) const { return mesh::evaluate(body_, time); }

 private:
  struct Link {
    int zone, parent;
    mesh::Rotation rotation;
    int rotor;     ///< of the body that turns it, or −1
    double sense;  ///< of the rotor's spin about the zone's axis
  };
  WindOptions wind_;
  Scales scales_;
  mesh::Motion body_;  ///< of zones without a parent
  size_t n_zones_;
  std::vector<Link> links_;  ///< parents before children
};

}  // namespace windhover::app
