// Rational Runge–Kutta on the equations that its formula can be read off from.
#include <catch2/catch.hpp>
#include <complex>

#include "flow_fixture.h"
#include "fluid/rational_runge_kutta.h"

using namespace windhover;
using namespace windhover::fluid;

namespace {

using Complex = std::complex<double>;

/// A complex number as a vector of two, shared among the ranks as PETSc shares them.
VecHandle vector(Complex z) {
  VecHandle v;
  petsc(VecCreateMPI(PETSC_COMM_WORLD, PETSC_DECIDE, 2, v.out()));
  PetscInt first = 0, end = 0;
  petsc(VecGetOwnershipRange(v, &first, &end));
  double* values = nullptr;
  petsc(VecGetArrayWrite(v, &values));
  for (PetscInt i = first; i < end; ++i) values[i - first] = i == 0 ? z.real() : z.imag();
  petsc(VecRestoreArrayWrite(v, &values));
  return v;
}

Complex number(Vec v) {
  PetscInt first = 0, end = 0;
  petsc(VecGetOwnershipRange(v, &first, &end));
  const double* values = nullptr;
  petsc(VecGetArrayRead(v, &values));
  double parts[2] = {};
  for (PetscInt i = first; i < end; ++i) parts[i] = values[i - first];
  petsc(VecRestoreArrayRead(v, &values));
  MPI_Allreduce(MPI_IN_PLACE, parts, 2, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
  return {parts[0], parts[1]};
}

/// One step of dz/dτ = −λz with μ = λΔτ.
Complex step(Complex mu, Complex z) {
  const Complex g1 = -mu * z, g2 = -mu * (z + 0.5 * g1);
  const VecHandle v = vector(z);
  rational_update(vector(g1), vector(g2), v);
  return number(v);
}

}  // namespace

TEST_CASE("rational Runge-Kutta: decay at every pseudo-step, of second order", "[rrk]") {
  const double mu = std::pow(10.0, GENERATE(range(-3, 4)));
  CAPTURE(mu);
  const Complex z(0.8, -0.3);
  const Complex real = step(mu, z);
  CHECK(std::abs(real) < std::abs(z));
  CHECK(std::abs(real - z * (1 - mu / 2) / (1 + mu / 2)) < 1e-14);
  const double error[2] = {std::abs(step(0.1, z) - z * std::exp(-0.1)), std::abs(step(0.05, z) - z * std::exp(-0.05))};
  CHECK(std::log2(error[0] / error[1]) == Approx(3).margin(0.1));  // of one step
}

TEST_CASE("rational Runge-Kutta: waves keep their amplitude, damped ones lose it", "[rrk]") {
  const double omega = std::pow(10.0, GENERATE(range(-2, 4)));
  CAPTURE(omega);
  const Complex z(0.8, -0.3);
  for (const double decay : {0.0, 0.1}) {
    const Complex mu(decay, omega);
    CHECK(std::abs(step(mu, z) - z * (1. - mu / 2.) / (1. + mu / 2.)) < 1e-13);
  }
  CHECK(std::abs(step({0, omega}, z)) == Approx(std::abs(z)).epsilon(1e-12));
}

TEST_CASE("rational Runge-Kutta: what is solved stays", "[rrk]") { CHECK(step(0, {0.8, -0.3}) == Complex(0.8, -0.3)); }
