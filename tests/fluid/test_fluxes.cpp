// Point kernels: consistency, upwinding, rotation invariance, derivatives against differences.
#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <random>

#include "fluid/flux_hllc.h"
#include "fluid/flux_kernels.h"
#include "fluid/flux_roe.h"
#include "fluid/flux_slau2.h"

using namespace windhover;
using namespace windhover::fluid;

namespace {

constexpr double kGamma = 1.4;
using S = State<double>;
using N = FaceNormal<double>;

S random_state(std::mt19937& random, double speed) {
  std::uniform_real_distribution<double> u(-1, 1);
  return {1 + 0.3 * u(random), speed * u(random), speed * u(random), speed * u(random), (1 + 0.3 * u(random)) / kGamma};
}

N random_normal(std::mt19937& random) {
  std::uniform_real_distribution<double> u(-1, 1);
  const Eigen::Vector3d n = Eigen::Vector3d(u(random), u(random), u(random)).normalized();
  return {n.x(), n.y(), n.z(), 0.5 * u(random)};
}

std::array<double, 5> list(const Flux<double>& f) { return {f.mass, f.x, f.y, f.z, f.energy}; }

void require_close(const Flux<double>& a, const Flux<double>& b, double tolerance = 1e-13) {
  for (int k = 0; k < 5; ++k) CHECK(list(a)[k] == Approx(list(b)[k]).epsilon(tolerance).margin(tolerance));
}

S rotated(const S& s, const Eigen::Matrix3d& R) {
  const Eigen::Vector3d v = R * Eigen::Vector3d(s.u, s.v, s.w);
  return {s.rho, v.x(), v.y(), v.z(), s.p};
}

}  // namespace

TEMPLATE_TEST_CASE("a flux between equal states is the physical flux", "[flux]", Roe, Hllc, Slau2) {
  std::mt19937 random(1);
  for (int i = 0; i < 100; ++i) {
    const S s = random_state(random, 2);
    const N n = random_normal(random);
    require_close(TestType::flux(s, s, n, 0.3, kGamma), physical_flux(s, n, kGamma));
  }
}

TEMPLATE_TEST_CASE("a supersonic face takes the upstream flux", "[flux]", Roe, Hllc) {
  const S l{1, 3, 0.1, 0, 0.7}, r{0.8, 2.5, 0, 0.2, 0.6};
  const N n{1, 0, 0, 0.1};
  require_close(TestType::flux(l, r, n, 1.0, kGamma), physical_flux(l, n, kGamma));
  const N back{-1, 0, 0, -0.1};
  require_close(TestType::flux(r, l, back, 1.0, kGamma), physical_flux(l, back, kGamma));
}

TEMPLATE_TEST_CASE("fluxes are independent of the axes and of which side is called left", "[flux]", Roe, Hllc, Slau2) {
  std::mt19937 random(2);
  for (int i = 0; i < 100; ++i) {
    const S l = random_state(random, 0.8), r = random_state(random, 0.8);
    const N n = random_normal(random);
    const Eigen::Matrix3d R = Eigen::AngleAxisd(0.1 + i, Eigen::Vector3d(1, 2, 3 + i).normalized()).toRotationMatrix();
    const Eigen::Vector3d turned = R * Eigen::Vector3d(n.x, n.y, n.z);
    const Flux<double> f = TestType::flux(l, r, n, 0.4, kGamma);
    const Flux<double> g =
        TestType::flux(rotated(l, R), rotated(r, R), N{turned.x(), turned.y(), turned.z(), n.grid_speed}, 0.4, kGamma);
    const Eigen::Vector3d m = R * Eigen::Vector3d(f.x, f.y, f.z);
    require_close(g, {f.mass, m.x(), m.y(), m.z(), f.energy});
    const Flux<double> opposite = TestType::flux(r, l, N{-n.x, -n.y, -n.z, -n.grid_speed}, 0.4, kGamma);
    require_close(opposite, -1.0 * f);
  }
}

TEMPLATE_TEST_CASE("a Galilean change of frame changes only what it must", "[flux]", Roe, Hllc, Slau2) {
  std::mt19937 random(3);
  for (int i = 0; i < 100; ++i) {
    const S l = random_state(random, 0.8), r = random_state(random, 0.8);
    const N n = random_normal(random);
    const Eigen::Vector3d W(0.3, -0.2, 0.5);
    const auto moved = [&](const S& s) { return S{s.rho, s.u + W.x(), s.v + W.y(), s.w + W.z(), s.p}; };
    const N m{n.x, n.y, n.z, n.grid_speed + W.dot(Eigen::Vector3d(n.x, n.y, n.z))};
    const Flux<double> f = TestType::flux(l, r, n, 0.4, kGamma), g = TestType::flux(moved(l), moved(r), m, 0.4, kGamma);
    const Eigen::Vector3d momentum(f.x, f.y, f.z);
    const Eigen::Vector3d expected = momentum + f.mass * W;
    require_close(g, {f.mass, expected.x(), expected.y(), expected.z(),
                      f.energy + momentum.dot(W) + 0.5 * f.mass * W.squaredNorm()});
  }
}

TEMPLATE_TEST_CASE("forward-mode derivatives of fluxes and far field agree with differences", "[flux]", Roe, Hllc, Slau2) {
  std::mt19937 random(4);
  using D = Dual<double>;
  for (int i = 0; i < 200; ++i) {
    const S l = random_state(random, 0.6), r = random_state(random, 0.6), dl = random_state(random, 1),
            dr = random_state(random, 1);
    const N n = random_normal(random);
    const auto along = [](const S& s, const S& d, double h) {
      return S{s.rho + h * d.rho, s.u + h * d.u, s.v + h * d.v, s.w + h * d.w, s.p + h * d.p};
    };
    const auto dual = [](const S& s, const S& d) {
      return State<D>{{s.rho, d.rho}, {s.u, d.u}, {s.v, d.v}, {s.w, d.w}, {s.p, d.p}};
    };
    const double h = 1e-6;
    const auto f = [&](double t) { return TestType::flux(along(l, dl, t), along(r, dr, t), n, 0.4, kGamma); };
    const Flux<D> exact = TestType::flux(dual(l, dl), dual(r, dr), n, D(0.4), kGamma);
    const Flux<double> difference = (0.5 / h) * (f(h) - f(-h));
    require_close({exact.mass.d, exact.x.d, exact.y.d, exact.z.d, exact.energy.d}, difference, 1e-7);

    const S far{1, 0.2, -0.1, 0.3, 1 / kGamma};
    const auto b = [&](double t) { return physical_flux(farfield_state(along(l, dl, t), far, n, kGamma), n, kGamma); };
    const Flux<D> exact_b = physical_flux(farfield_state(dual(l, dl), far, n, kGamma), n, kGamma);
    require_close({exact_b.mass.d, exact_b.x.d, exact_b.y.d, exact_b.z.d, exact_b.energy.d},
                  (0.5 / h) * (b(h) - b(-h)), 1e-7);
  }
}

TEST_CASE("boundary states: walls let nothing through, a far field in equilibrium passes the free stream", "[boundary]") {
  std::mt19937 random(5);
  for (int i = 0; i < 50; ++i) {
    const S s = random_state(random, 0.6);
    const N n = random_normal(random);
    const Flux<double> wall = physical_flux(slip_state(s, n), n, kGamma);
    require_close(wall, {0, s.p * n.x, s.p * n.y, s.p * n.z, s.p * n.grid_speed});
    const S same = farfield_state(s, s, n, kGamma);
    require_close(physical_flux(same, n, kGamma), physical_flux(s, n, kGamma));
  }
}

TEMPLATE_TEST_CASE("eight lanes give what one gives", "[flux]", double, float) {
  using P = PackOf<TestType>;
  std::mt19937 random(6);
  S l[8], r[8];
  State<P> pl, pr;
  for (int i = 0; i < 8; ++i) {
    l[i] = random_state(random, 0.6), r[i] = random_state(random, 0.6);
    pl.rho.set(i, l[i].rho), pl.u.set(i, l[i].u), pl.v.set(i, l[i].v), pl.w.set(i, l[i].w), pl.p.set(i, l[i].p);
    pr.rho.set(i, r[i].rho), pr.u.set(i, r[i].u), pr.v.set(i, r[i].v), pr.w.set(i, r[i].w), pr.p.set(i, r[i].p);
  }
  const FaceNormal<P> n{0.6, 0.8, 0.0, 0.1};
  const Flux<P> f = Roe::flux(pl, pr, n, P(0.5), kGamma);
  const double tolerance = std::is_same_v<TestType, double> ? 1e-13 : 2e-6;
  for (int i = 0; i < 8; ++i)
    require_close({f.mass[i], f.x[i], f.y[i], f.z[i], f.energy[i]}, Roe::flux(l[i], r[i], N{0.6, 0.8, 0, 0.1}, 0.5, kGamma),
                  tolerance);
  P rows[8], back[8];
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j) rows[i].set(j, 8 * i + j);
  transpose(rows, back);
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j) CHECK(back[i][j] == 8 * j + i);
}

TEMPLATE_TEST_CASE("three rows of five are packed without gaps and found again", "[flux]", double, float) {
  using P = PackOf<TestType>;
  alignas(64) TestType packed[16] = {};
  P rows[3];
  for (int d = 0; d < 3; ++d)
    for (int k = 0; k < 8; ++k) rows[d].set(k, k < kVariables ? 10 * d + k : -1);
  store_fives(rows[0], rows[1], rows[2], packed);
  for (int i = 0; i < 15; ++i) CHECK(packed[i] == 10 * (i / kVariables) + i % kVariables);
  const P found[3] = {window<0>(packed), window<5>(packed), window<10>(packed)};
  for (int d = 0; d < 3; ++d)
    for (int k = 0; k < 8; ++k) CHECK(first_lanes<kVariables>(found[d])[k] == (k < kVariables ? 10 * d + k : 0));
}

TEST_CASE("eight doubles become floats, lane by lane, and floats doubles", "[flux]") {
  Pack x;
  for (int i = 0; i < 8; ++i) x.set(i, std::exp(i) / 3);
  const PackOf<float> rounded = rounded_to<float>(x);
  const Pack back = widened(rounded);
  for (int i = 0; i < 8; ++i) {
    CHECK(rounded[i] == static_cast<float>(x[i]));
    CHECK(back[i] == rounded[i]);
  }
}
