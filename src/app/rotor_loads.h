// What the air does to each rotor of a run.
#pragma once
#include "app/scales.h"
#include "fluid/euler.h"

namespace windhover::app {

/// Thrust is along the rotor's axis. The torque is positive where the air resists the turning in the rotor's direction.
struct RotorLoads {
  double rpm = 0;                            ///< relative to its parent zone, positive in the rotor's direction
  double angle_deg = 0;                      ///< of the first blade about the axis, right-handed, in [0, 360)
  double thrust_N = 0, torque_Nm = 0;        ///< blades and hub
  double hub_thrust_N = 0, hub_torque_Nm = 0;  ///< the hub's part of them
};

/// Propellers' coefficients: CT = T/(ρ n² D⁴), CP = 2π Q/(ρ n² D⁵), n in turns per second; NaN at rest.
double thrust_coefficient(double thrust_N, double rpm, double density_kg_m3, double radius_m);
double power_coefficient(double torque_Nm, double rpm, double density_kg_m3, double radius_m);

/// A rotor of the case as the mesh has it.
struct MeshRotor {
  const geometry::RotorOptions* options = nullptr;
  int zone = 0, parent = 0;
  int blades = -1, hub = -1;  ///< patches; hub −1: there is none
};

/// The case's rotors with blades, in its order.
std::vector<MeshRotor> mesh_rotors(const Case& c, const mesh::Mesh& mesh);

/// The loads of a rotor, of one flux per patch, at these frames (nondimensional).
RotorLoads rotor_loads(const Case& c, const MeshRotor& rotor, const std::vector<fluid::PatchFlux>& fluxes,
                       const fluid::Frames& frames);

}  // namespace windhover::app
