// Between SI, in which users write and read, and the nondimensional numbers of the flow solver.
#pragma once
#include "app/case.h"

namespace windhover::app {

/// Multiply a nondimensional quantity by its scale to get SI.
struct Scales {
  double length, velocity, density;

  explicit Scales(const FluidOptions& f)
      : length(f.length_m), velocity(f.sound_speed_m_s), density(f.density_kg_m3) {}
  double time() const { return length / velocity; }
  double pressure() const { return density * velocity * velocity; }
  double force() const { return pressure() * length * length; }
  double moment() const { return force() * length; }
};

}  // namespace windhover::app
