// The wall faces of a rotor's blades, as its tables along the span need them.
#pragma once
#include "app/rotor_loads.h"
#include "geometry/blade.h"

namespace windhover::app {

/// Lengths in metres, in the zone's frame, from the rotor's centre.
struct BladeFace {
  int blade = 0;                             ///< from 0
  std::vector<std::vector<Vec3>> triangles;  ///< the plane triangles it is made of; normals into the blade
  const mesh::FaceBlock* block = nullptr;
  int lane = 0;
};

class BladeFaces {
 public:
  /// Faces of this rank, in the order of the patch's blocks. UserError: blade stations that do not fit together.
  BladeFaces(const Case& c, const mesh::Mesh& mesh, const MeshRotor& rotor);

  const std::vector<BladeFace>& all() const { return faces_; }
  const geometry::RotorOptions& rotor() const { return *rotor_.options; }
  int patch() const { return rotor_.blades; }

  /// Unit vector along a blade, across the rotor's axis: r along it is where a strip or section is.
  const Vec3& along(int blade) const { return along_[blade]; }
  /// The blade's section as the case gives it, from the rotor's centre.
  geometry::BladeSection section(int blade, double r_m) const;
  /// ½ ρ (Ω r)², Pa.
  double dynamic_pressure(double rpm, double r_m) const;

 private:
  int blade_of(const Vec3& place) const;

  double density_kg_m3_;
  MeshRotor rotor_;
  geometry::Blades blades_;
  std::vector<Vec3> along_;
  std::vector<BladeFace> faces_;
};

}  // namespace windhover::app
