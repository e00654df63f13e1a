// SLAU2 flux on a moving face (Kitamura & Shima, J. Comput. Phys. 245 (2013) 62): all speeds, no reference Mach number.
#pragma once
#include "base/dual.h"
#include "fluid/gas.h"

namespace windhover::fluid {

struct Slau2 {
  /// Pressure's share from the side whose relative normal Mach number is m (side = +1 left, −1 right).
  template <class T>
  static T pressure_share(const T& m, double side) {
    const T x = side * m;  // by symmetry the right side is the left one mirrored
    const T inside = 0.25 * (x + 1.0) * (x + 1.0) * (2.0 - x);
    return select(x < T(-1.0), T(0.0), select(T(1.0) < x, T(1.0), inside));
  }

  /// `mach`: speed relative to the face over the speed of sound, at most 1.
  template <class T, class G>
  static Flux<T> flux(const State<T>& l, const State<T>& r, const FaceNormal<G>& n, const T& mach, double gamma) {
    using std::sqrt;
    const T ul = normal_speed(l, n) - n.grid_speed, ur = normal_speed(r, n) - n.grid_speed;
    const T c = 0.5 * (sqrt(gamma * l.p / l.rho) + sqrt(gamma * r.p / r.rho));
    const T inverse = 1.0 / c;
    const T ml = ul * inverse, mr = ur * inverse;

    const T al = absolute(ul), ar = absolute(ur);
    const T mean_speed = (l.rho * al + r.rho * ar) / (l.rho + r.rho);
    const T g = -maximum(minimum(ml, T(0.0)), T(-1.0)) * minimum(maximum(mr, T(0.0)), T(1.0));
    const T chi = (1.0 - mach) * (1.0 - mach);
    const T mass = 0.5 * (l.rho * (ul + mean_speed + g * (al - mean_speed)) +
                          r.rho * (ur - mean_speed - g * (ar - mean_speed)) - chi * inverse * (r.p - l.p));

    const T fl = pressure_share(ml, 1.0), fr = pressure_share(mr, -1.0);
    const T pressure = 0.5 * (l.p + r.p) + 0.5 * (fl - fr) * (l.p - r.p) +
                       mach * c * c * (fl + fr - 1.0) * (0.5 * (l.rho + r.rho));

    const double h = gamma / (gamma - 1.0);
    const auto from_left = T(0.0) < mass;
    const T enthalpy = select(from_left, h * (l.p / l.rho) + 0.5 * speed_squared(l), h * (r.p / r.rho) + 0.5 * speed_squared(r));
    return {mass, mass * select(from_left, l.u, r.u) + pressure * n.x,
            mass * select(from_left, l.v, r.v) + pressure * n.y, mass * select(from_left, l.w, r.w) + pressure * n.z,
            mass * enthalpy + pressure * n.grid_speed};
  }
};

}  // namespace windhover::fluid
