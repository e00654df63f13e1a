// Roe's flux on a moving face (Roe 1981), with Rieper's low-Mach correction (J. Comput. Phys. 230 (2011) 5263).
#pragma once
#include "base/dual.h"
#include "fluid/gas.h"

namespace windhover::fluid {

struct Roe {
  /// |x| rounded off below delta (Harten): differentiable, and no expansion shocks. `inverse` = 1/delta.
  template <class T>
  static T rounded(const T& x, const T& delta, const T& inverse) {
    const T a = absolute(x);
    return select(a < delta, 0.5 * (x * x * inverse + delta), a);
  }

  /// `mach`: scale of the normal-velocity jump, 0..1; 1 is plain Roe.
  template <class T, class G>
  static Flux<T> flux(const State<T>& l, const State<T>& r, const FaceNormal<G>& n, const T& mach, double gamma) {
    return 0.5 * (physical_flux(l, n, gamma) + physical_flux(r, n, gamma) - dissipation(l, r, n, mach, gamma));
  }

  template <class T, class G>
  static Flux<T> dissipation(const State<T>& l, const State<T>& r, const FaceNormal<G>& n, const T& mach,
                             double gamma) {
    // Roe's averages; √ρr / (√ρl + √ρr) = ρ / (ρl + ρ)
    const T inverse_rho = inverse_sqrt(l.rho * r.rho), rho = l.rho * r.rho * inverse_rho;
    const T weight = rho * reciprocal(l.rho + rho);
    const auto mean = [&weight](const T& a, const T& b) { return a + weight * (b - a); };
    const double g = gamma / (gamma - 1.0);
    const T inverse_both = inverse_rho * inverse_rho;  // 1/(ρl ρr)
    const T u = mean(l.u, r.u), v = mean(l.v, r.v), w = mean(l.w, r.w);
    const T enthalpy = mean(g * (l.p * r.rho * inverse_both) + 0.5 * speed_squared(l),
                            g * (r.p * l.rho * inverse_both) + 0.5 * speed_squared(r));
    const T kinetic = 0.5 * (u * u + v * v + w * w);
    const T c_squared = (gamma - 1.0) * (enthalpy - kinetic);
    const T inverse_c = inverse_sqrt(c_squared), c = c_squared * inverse_c;
    const T un = u * n.x + v * n.y + w * n.z;
    const T relative = un - n.grid_speed;

    // wave strengths
    const T du = r.u - l.u, dv = r.v - l.v, dw = r.w - l.w, dp = r.p - l.p;
    const T dun = du * n.x + dv * n.y + dw * n.z;
    const T half = 0.5 * inverse_c * inverse_c;
    const T jump = rho * c * (mach * dun);
    const T slow = rounded(relative - c, 0.1 * c, 10.0 * inverse_c) * half * (dp - jump);
    const T fast = rounded(relative + c, 0.1 * c, 10.0 * inverse_c) * half * (dp + jump);
    // rounded off below the velocity's jump, as Harten and Hyman (1983) do for sonic points: without it Newton's method
    // cycles in cells where the flow turns over a face. Jumps are of second order in smooth flow, this of fourth
    const T shift_squared = du * du + dv * dv + dw * dw + 1e-12 * (c * c);
    const T inverse_shift = inverse_sqrt(shift_squared);
    const T contact_speed = rounded(relative, shift_squared * inverse_shift, inverse_shift);
    const T entropy = contact_speed * (r.rho - l.rho - 2.0 * half * dp);
    const T shear = contact_speed * rho;

    const T mass = slow + fast + entropy;
    const T acoustic = c * (fast - slow) - shear * dun;
    return {mass, mass * u + acoustic * n.x + shear * du, mass * v + acoustic * n.y + shear * dv,
            mass * w + acoustic * n.z + shear * dw,
            (slow + fast) * enthalpy + entropy * kinetic + acoustic * un + shear * (u * du + v * dv + w * dw)};
  }
};

}  // namespace windhover::fluid
