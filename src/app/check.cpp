// `windhover check`: everything but the steps.
#include "app/flight.h"
#include "app/flow_setup.h"
#include "app/simulation.h"
#include "app/zone_tree.h"
#include <fmt/format.h>
#include <cmath>
#include "base/memory.h"
#include "geometry/mass.h"
#include "mesh/quality.h"
namespace windhover::app {
namespace {
/// Seconds of one residual.
double time_residual(fluid::EulerOperator& euler, Vec q, const fluid::Frames& frames) {
  const VecHandle out = euler.make_vector();
  euler.residual(q, frames, out);
  const double start = MPI_Wtime();
  constexpr int repeats = 3;
  for (int i = 0; i < repeats; ++i) {
    double* values = nullptr;  // as if changed, or what is known of the same state would be used again
    petsc(VecGetArray(q, &values));
    petsc(VecRestoreArray(q, &values));
    euler.residual(q, frames, out);
  }
  double seconds = (MPI_Wtime() - start) / repeats;
  MPI_Allreduce(MPI_IN_PLACE, &seconds, 1, MPI_DOUBLE, MPI_MAX, euler.mesh().comm);
  return seconds;
}

std::string place(const mesh::Worst& worst, double scale) {
  return fmt::format("at ({:.4g}, {:.4g}, {:.4g}) m", scale * worst.place.x(), scale * worst.place.y(),
                     scale * worst.place.z());
}

std::string mass_text(const Case& c) {
  const auto mass = geometry::aircraft_mass(c.airframe, c.rotor);
  if (mass.mass_kg == 0) return "";
  const auto clean = [](double value) { return std::abs(value) < 1e-9 ? 0 : value; };  // sums of mirror images leave round-off
  const auto& g = mass.center_m;
  const auto& i = mass.inertia_kg_m2;
  return fmt::format(
      "parts     mass {:.4g} kg, centre of gravity ({:.4g}, {:.4g}, {:.4g}) m\n"
      "          moments of inertia {:.4g}, {:.4g}, {:.4g}, products xy {:.3g}, xz {:.3g}, yz {:.3g} kg m²\n",
      mass.mass_kg, clean(g.x()), clean(g.y()), clean(g.z()), i(0, 0), i(1, 1), i(2, 2), clean(-i(0, 1)), clean(-i(0, 2)),
      clean(-i(1, 2)));
}

}  // namespace

int check_simulation(const Case& c) {
  const Scales s(c.fluid);
  ZonedMesh zoned = read_zones(c, PETSC_COMM_WORLD);
  const mesh::Mesh& mesh = zoned.mesh;
  fluid::EulerOperator euler(mesh, flow_model(c), std::move(zoned.interfaces));
  fluid::FlowSolver solver(euler, flow_options(c));
  const fluid::Frames frames = initial_frames(c, ZoneTree(c, mesh));
  const Vec q = solver.state().q;
  fluid::set_initial(euler, frames, initial_state(c), q);
  const mesh::Quality quality = mesh::measure_quality(mesh);
  const double dt = step_seconds(c) / s.time();
  const double courant = euler.courant_number(q, frames, dt);
  const double residual = time_residual(euler, q, frames);
  double memory = resident_bytes();
  MPI_Allreduce(MPI_IN_PLACE, &memory, 1, MPI_DOUBLE, MPI_SUM, mesh.comm);

  // a step in developed flow: 11 residuals on a rotor, 18 on a quadcopter (docs/performance.md), as they are timed here
  const auto& scheme = fluid::time_scheme(c.time.scheme);
  const double residuals_per_step = scheme.implicit ? 15.0 * (scheme.stages > 1 && scheme.a[0][0] != 0 ? 2 : 1) : scheme.stages;
  // bytes a cell of what is not made yet: matrix, factor, ten pairs of Krylov vectors, products near interfaces; runs
  // ended within 9 % of it without the last
  const double near_interfaces = euler.sliding_faces().empty() ? 0 : 136;
  const double implicit = 1100 + (c.solver.ilu_levels > 0 ? 750 : 450) + 20 * 2 * 10 + near_interfaces;
  const double later = scheme.implicit && c.solver.method == "newton_krylov" ? mesh.n_global * implicit : 0.0;
  std::string text = fmt::format("case      {}\nmesh      {}: {} cells\n", c.file.string(), c.mesh.file, mesh.n_global);
  for (const auto& zone : mesh.zones) text += fmt::format("zone      {}\n", zone.name);
  for (const auto& patch : mesh.patches)
    text += fmt::format("surface   {}: {}\n", patch.name,
                        c.fluid.boundary.contains(patch.name) ? c.fluid.boundary.at(patch.name) : "sliding");
  const mesh::Worst &edge = quality.smallest_edge, &angle = quality.smallest_dihedral_deg,
                    &ratio = quality.largest_volume_ratio;
  text += fmt::format("quality   smallest edge {:.4g} m {}\n", s.length * edge.value, place(edge, s.length));
  text += fmt::format("          smallest dihedral angle {:.3g} deg {}\n", angle.value, place(angle, s.length));
  text += fmt::format("          largest volume ratio of neighbours {:.3g} {}\n", ratio.value, place(ratio, s.length));
  const mesh::Worst& cell = quality.smallest_cell;
  text += fmt::format("          smallest cell, root of its volume, {:.4g} m, crossed by sound in {:.3g} s {}\n", s.length * cell.value,
                      s.time() * cell.value, place(cell, s.length));
  text += mass_text(c);
  const double step_s = step_seconds(c), turn_deg_s = fastest_rotation_deg_s(c);
  text += fmt::format("step      {:.6g} s, acoustic Courant number up to {:.4g}; 1 at {:.4g} s", step_s, courant, step_s / courant);
  text += turn_deg_s > 0 ? fmt::format(" or {:.4g} deg\n", step_s / courant * turn_deg_s) : "\n";
  text += fmt::format("memory    about {:.3g} GB\n", (memory + later) * 1e-9);
  const int steps = step_count(c);
  text += fmt::format("time      about {:.2g} s a step, {:.2g} s for {} steps\n", residuals_per_step * residual,
                      residuals_per_step * residual * steps, steps);
  petsc(PetscPrintf(mesh.comm, "%s", text.c_str()));
  return 0;
}

}  // namespace windhover::app
