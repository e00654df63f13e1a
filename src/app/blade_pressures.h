// The pressure around chosen sections of a rotor's blades.
#pragma once
#include "app/blade_faces.h"

namespace windhover::app {

/// Where the plane of a section, across the pitch axis, cuts a face of a blade: the middle of the cut.
struct SectionPoint {
  int blade = 0;  ///< from 0
  double r_over_R = 0;
  double x_over_c = 0;  ///< along the chord from the leading edge
  int side = 1;         ///< +1 where the surface faces up from the chord (towards the thrust), −1 below
};

class BladePressures {
 public:
  /// Collective.
  BladePressures(const BladeFaces& faces, const mesh::Mesh& mesh, double length_m, std::vector<double> sections_r_over_R);

  /// By blade, outwards, upper side first, along the chord: the same on any number of ranks.
  const std::vector<SectionPoint>& points() const { return points_; }
  /// This rank's points, for EulerOperator::surface_states.
  const std::vector<mesh::FaceBlock>& blocks() const { return blocks_; }

  /// (p − p∞)/(½ρ(Ωr)²) at each point, from the pressures above the free stream's (Pa) at this rank's. Collective.
  std::vector<double> values(std::span<const double> pressures, double rpm, MPI_Comm comm) const;

 private:
  struct Own;
  void cut(const BladeFaces& faces, const mesh::Mesh& mesh, double length_m, size_t number, double r_over_R,
           std::vector<Own>& own);
  void number_points(std::vector<Own> own, MPI_Comm comm);

  std::vector<SectionPoint> points_;
  std::vector<double> dynamic_pressure_;  ///< of each point at 1 rpm, Pa
  std::vector<int> own_;                  ///< number of each of this rank's points
  std::vector<mesh::FaceBlock> blocks_;
};

}  // namespace windhover::app
