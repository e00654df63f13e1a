// Mass, centre of gravity and inertia of bodies put together from parts.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "geometry/airframe_options.h"
#include "geometry/rotor_options.h"

namespace windhover::geometry {

/// In the axes of the case.
struct MassProperties {
  double mass_kg = 0;
  Vec3 center_m = Vec3::Zero();                             ///< centre of gravity
  Eigen::Matrix3d inertia_kg_m2 = Eigen::Matrix3d::Zero();  ///< tensor about the centre: −∫xy dm off the diagonal
};

/// The whole of several bodies, by the parallel-axis theorem.
MassProperties combined(const std::vector<MassProperties>& bodies);

/// A homogeneous part. The rounding of a cylinder's rims is left out, that of a box is exact.
MassProperties mass_of(const PartOptions& part);

/// Moment of inertia about the axis over the mass: blades as rods whose mass per length goes with the chord squared, since
/// their thickness goes with the chord; the hub is left out. UserError: stations that do not fit together.
double squared_radius_of_gyration(const BladeOptions& blade);

/// A rotor averaged over a turn: flat, half of the axial moment across the axis.
MassProperties mass_of(const RotorOptions& rotor);

/// Airframe and rotors; the mass is 0 when the case gives none to any of them.
MassProperties aircraft_mass(const AirframeOptions& airframe, const std::vector<RotorOptions>& rotors);

}  // namespace windhover::geometry
