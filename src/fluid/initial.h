// Initial states, by position in the inertial frame.
#pragma once
#include <functional>

#include "fluid/euler.h"

namespace windhover::fluid {

using InitialState = std::function<State<double>(const mesh::Vec3& x)>;

InitialState uniform_state(const State<double>& s);

/// Two states separated by the plane direction·x = position; velocities already inertial.
InitialState riemann_state(const mesh::Vec3& direction, double position, const State<double>& left,
                           const State<double>& right);

/// Isentropic vortex about an axis along z (Shu 1998) added to `far`: core radius R, velocity
/// strength/(2π) exp((1−r²/R²)/2) r/R in units of the far field's speed of sound.
InitialState vortex_state(const mesh::Vec3& center, double strength, double core_radius, const State<double>& far,
                          double gamma);

/// Sets q to means over the cells (by quadrature of their tetrahedra), in the frames given.
void set_initial(const EulerOperator& euler, const Frames& frames, const InitialState& initial, Vec q);

/// Adds one velocity to all of the air.
void add_velocity(const mesh::Vec3& velocity, Vec q);

}  // namespace windhover::fluid
