// How the air loads a rotor's blades along the span.
#pragma once
#include "app/blade_faces.h"

namespace windhover::app {

/// A stretch of a blade between two planes across its pitch axis; the first and last reach to the blade's ends.
struct BladeStrip {
  int blade = 0;                     ///< from 0
  double r_over_R = 0, chord_m = 0;  ///< at its middle
};

/// What the strips bear. They cut the faces exactly, so that they add up to the blades' thrust and torque to round-off.
class BladeStrips {
 public:
  /// As many strips of the same width on each blade, by blade, then outwards.
  BladeStrips(const BladeFaces& faces, int strips_per_blade);

  const std::vector<BladeStrip>& all() const { return strips_; }
  double width_m() const { return width_m_; }

  /// Of each strip dT/dr (N/m), dQ/dr (N, positive where the air resists the turning) and the coefficient of the force along
  /// the section's normal, N'/(½ρ(Ωr)²c), from the pressures above the free stream's (Pa) on the faces of this rank, in their
  /// order. Collective.
  static constexpr int kValues = 3;
  std::vector<double> values(std::span<const double> pressures, double rpm, MPI_Comm comm) const;

 private:
  /// What a unit of pressure on a part of a face does to its strip.
  struct Part {
    int face = 0, strip = 0;
    double load[kValues] = {};
  };
  double border_m(int i) const { return root_m_ + i * width_m_; }
  void add(const BladeFaces& faces, int number, const std::vector<Vec3>& triangle);

  int per_blade_;
  double root_m_, width_m_;
  std::vector<BladeStrip> strips_;
  std::vector<double> dynamic_pressure_;  ///< of each strip at 1 rpm, Pa
  std::vector<Part> parts_;
};

}  // namespace windhover::app
