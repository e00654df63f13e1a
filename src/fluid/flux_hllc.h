// HLLC flux on a moving face (Toro, Spruce & Speares 1994; wave speeds of Batten et al. 1997), written as a choice among
// four states without branches.
#pragma once
#include "base/dual.h"
#include "fluid/gas.h"

namespace windhover::fluid {

struct Hllc {
  template <class T, class G>
  static Flux<T> flux(const State<T>& l, const State<T>& r, const FaceNormal<G>& n, const T&, double gamma) {
    using std::sqrt;
    const T ul = normal_speed(l, n) - n.grid_speed, ur = normal_speed(r, n) - n.grid_speed;
    const T cl = sqrt(gamma * l.p / l.rho), cr = sqrt(gamma * r.p / r.rho);
    // Roe averages bound the fastest waves
    const T root_l = sqrt(l.rho), root_r = sqrt(r.rho);
    const T weight = root_r / (root_l + root_r);
    const T jump = ur - ul;
    const T un = ul + weight * jump;
    const T c2 = cl * cl + weight * (cr * cr - cl * cl) + 0.5 * (gamma - 1.0) * weight * (1.0 - weight) * jump * jump;
    const T c = sqrt(c2);
    const T sl = minimum(ul - cl, un - c), sr = maximum(ur + cr, un + c);
    const T ml = l.rho * (sl - ul), mr = r.rho * (sr - ur);  // mass swept by the outer waves: ml < 0 < mr
    const T contact = (r.p - l.p + ml * ul - mr * ur) / (ml - mr);

    const auto from_left = T(0.0) < contact;
    const State<T> k{select(from_left, l.rho, r.rho), select(from_left, l.u, r.u), select(from_left, l.v, r.v),
                     select(from_left, l.w, r.w), select(from_left, l.p, r.p)};
    const T s = select(from_left, sl, sr), uk = select(from_left, ul, ur);
    // the wave on the chosen side moves towards it (star state counts), or away (outer state counts)
    const T reach = select(from_left, minimum(sl, T(0.0)), maximum(sr, T(0.0)));
    const T density_ratio = (s - uk) / (s - contact);
    const T energy = total_energy(k, gamma);
    const T gain = k.rho * density_ratio;  // star density
    const T push = gain * (contact - uk);
    const T star_energy =
        density_ratio * (energy + (contact - uk) * (k.rho * (contact + n.grid_speed) + k.p / (s - uk)));
    const Flux<T> outer = physical_flux(k, n, gamma);
    const Flux<T> change{gain - k.rho, (gain - k.rho) * k.u + push * n.x, (gain - k.rho) * k.v + push * n.y,
                         (gain - k.rho) * k.w + push * n.z, star_energy - energy};
    return outer + reach * change;
  }
};

}  // namespace windhover::fluid
