// What a case says of a rotor: where it is, how it turns, its blades and hub, its zone and the sizes of its mesh.
#pragma once
#include <string>
#include <vector>

#include "geometry/airframe_options.h"

namespace windhover::geometry {

/// An airfoil at a place along the blade.
struct SectionOptions {
  double r_over_R = 0;
  std::string airfoil;
};

/// Sections along the radius; lists have one entry per station, or none where they may be missing.
struct BladeOptions {
  int count = 0;
  double radius_m = 0;
  std::string stations;  ///< CSV file in place of the lists
  std::vector<double> r_over_R, c_over_R, beta_deg, sweep_over_R, offset_over_R;
  std::string airfoil;  ///< after complete(): set where there are no sections
  std::vector<SectionOptions> section;
  double trailing_edge_thickness = 0;
  std::string tip = "rounded";
  double collective_deg = 0, precone_deg = 0;
};

/// A cylinder with rounded edges about the rotor's axis.
struct HubOptions {
  double radius_m = 0, from_m = 0, to_m = 0, rounding_m = 0;
};

struct RotorZoneOptions {
  double radius_m = 0, from_m = 0, to_m = 0;
};

/// Sizes at mesh.refine = 1.
struct RotorSizeOptions {
  double leading_edge = 0.015, trailing_edge = 0.02, chord = 0.1;  ///< along the chord, in chords
  double root_m = 0, tip_m = 0, span_m = 0;                         ///< along the span
  double hub_m = 0, interface_m = 0, zone_m = 0;
  double growth = 0.3;
  double wake_m = 0, wake_length_m = 0;  ///< below the zone
  double smallest_m = 0;                 ///< along the chord
};

struct RotorOptions {
  std::string name = "rotor", like;  ///< after load_case: like is empty
  Vec3 center_m = Vec3::Zero(), axis = Vec3::UnitY();
  std::string direction = "counter_clockwise";
  double rpm = 0, angle_deg = 0, mass_kg = 0;
  BladeOptions blade;
  HubOptions hub;
  RotorZoneOptions zone;
  RotorSizeOptions size;

  /// +1: right-handed about the axis.
  int spin() const { return direction == "counter_clockwise" ? 1 : -1; }
};

/// The ball around all.
struct FarfieldOptions {
  Vec3 center_m = Vec3::Zero();
  double radius_m = 0, size_m = 0;
};

/// All that the mesher needs.
struct GeometryOptions {
  double refine = 1;
  FarfieldOptions farfield;
  AirframeOptions airframe;
  std::vector<RotorOptions> rotor;
};

}  // namespace windhover::geometry
