// What the parts of a step cost: microseconds per cell, medians. Usage: windhover_bench MESH NAME JSON_OUT
#include <algorithm>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "bandwidth.h"
#include "base/memory.h"
#include "fluid/flow_solver.h"
#include "fluid/initial.h"

using namespace windhover;
using namespace windhover::fluid;

namespace {

struct Timing {
  double median, spread;  ///< seconds; spread: largest minus smallest
};

Timing time_of(const std::function<void()>& work, int repeats) {
  work();
  std::vector<double> seconds;
  for (int i = 0; i < repeats; ++i) {
    MPI_Barrier(PETSC_COMM_WORLD);
    const double start = MPI_Wtime();
    work();
    double s = MPI_Wtime() - start;
    MPI_Allreduce(MPI_IN_PLACE, &s, 1, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD);
    seconds.push_back(s);
  }
  std::sort(seconds.begin(), seconds.end());
  return {seconds[seconds.size() / 2], seconds.back() - seconds.front()};
}

/// Bytes a second-order residual must move if every array passes once: the least, with perfect caches in between.
double bytes_of_residual(const mesh::Mesh& mesh) {
  double faces = mesh.faces.size();
  for (const auto& patch : mesh.patches) faces += patch.blocks.size();
  const double pairs = mesh.cell_point_start[mesh.n_gradient];
  const double cells = mesh.n_owned;
  return faces * sizeof(mesh::FaceBlock)           // face geometry
         + pairs * (12 + 28)                       // node weights and gradient coefficients with their indices
         + cells * (40 + 24 + 64 + 64 + 64)        // state, centroid; rows written, read for nodes, read for faces
         + cells * (192 + 192)                     // gradients written, read
         + cells * (64 + 64 + 40);                 // rates summed, read (and cleared), stored
}

/// Of all ranks, without what has been freed.
double memory_in_use() {
  release_free_memory();
  double bytes = resident_bytes();
  MPI_Allreduce(MPI_IN_PLACE, &bytes, 1, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
  return bytes;
}

class Bench {
 public:
  Bench(const std::string& file, std::string name)
      : name_(std::move(name)), before_(memory_in_use()), mesh_(mesh::read_mesh(file, 1.0, PETSC_COMM_WORLD)) {
    MPI_Comm_size(PETSC_COMM_WORLD, &ranks_);
  }

  nlohmann::ordered_json run() {
    bandwidth_ = measured_bandwidth(PETSC_COMM_WORLD);
    residuals();
    jacobians();
    step();
    return results_;
  }

 private:
  void report(const std::string& what, const Timing& t, nlohmann::ordered_json more = {}) {
    nlohmann::ordered_json j = {{"name", name_ + "/" + what}, {"cells", mesh_.n_global}, {"ranks", ranks_},
                                {"median", 1e6 * t.median / mesh_.n_global}, {"spread", 1e6 * t.spread / mesh_.n_global},
                                {"unit", "us per cell"}, {"bandwidth_GB_s", 1e-9 * bandwidth_}};
    if (!more.is_null()) j.update(more);
    results_.push_back(j);
    std::string extra;
    for (const auto& [key, value] : more.items()) extra += "  " + key + " " + value.dump();
    petsc(PetscPrintf(PETSC_COMM_WORLD, "%-40s %8.4f us/cell  +- %.4f%s\n", (name_ + "/" + what).c_str(),
                      1e6 * t.median / mesh_.n_global, 1e6 * t.spread / mesh_.n_global, extra.c_str()));
  }

  FlowModel model(Reconstruction r) const {
    FlowModel m;
    m.reconstruction = r;
    for (const auto& patch : mesh_.patches) m.boundary[patch.name] = BoundaryKind::farfield;
    m.far = {1.0, 0.2, 0.1, 0.0, 1 / 1.4};
    return m;
  }
  Frames frames() const {
    mesh::FrameState f;
    f.omega = {0.1, 0.2, 0.3};
    return Frames(mesh_.zones.size(), f);
  }
  VecHandle start(EulerOperator& euler) const {
    VecHandle q = euler.make_vector();
    set_initial(euler, frames(), vortex_state({0.5, 0.5, 0}, 0.5, 0.2, euler.model().far, 1.4), q);
    return q;
  }

  void residuals() {
    double bytes = bytes_of_residual(mesh_);
    MPI_Allreduce(MPI_IN_PLACE, &bytes, 1, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
    const auto measure = [&](const std::string& what, const FlowModel& m) {
      EulerOperator euler(mesh_, m);
      const VecHandle q = start(euler), out = euler.make_vector();
      const Timing t = time_of([&] { euler.residual(q, frames(), out); }, 15);
      report(what, t, {{"bytes_per_cell", bytes / mesh_.n_global}, {"roofline_fraction", bytes / bandwidth_ / t.median}});
    };
    measure("residual roe", model(Reconstruction::linear));
    measure("residual roe limited", model(Reconstruction::limited));
    for (const FluxKernels* flux : {&kHllcKernels, &kSlau2Kernels}) {
      FlowModel m = model(Reconstruction::limited);
      m.flux = flux;
      measure(std::string("residual ") + flux->name + " limited", m);
    }
    FlowModel m = model(Reconstruction::linear);
    m.gradient = GradientKind::least_squares;
    measure("residual roe least squares", m);
  }

  void jacobians() {
    EulerOperator euler(mesh_, model(Reconstruction::linear));
    const VecHandle q = start(euler), dq = euler.make_vector(), out = euler.make_vector(), moved = euler.make_vector();
    petsc(VecSet(dq, 0.01));
    euler.linearize(q, frames());
    report("product exact", time_of([&] { euler.derivative(dq, out); }, 15));
    report("product exact, single precision", time_of([&] { euler.derivative(dq, out, {}, {}, true); }, 15));
    report("product by difference", time_of([&] {
             petsc(VecWAXPY(moved, 1e-7, dq, q));
             euler.residual(moved, frames(), out);
             petsc(VecAXPY(out, -1.0, q));
             petsc(VecScale(out, 1e7));
           }, 15));
    BlockJacobian jacobian(mesh_);
    const double mass = 40 * euler.courant_number(q, frames(), 1.0) / 1000;  // acoustic Courant number 25
    report("assembly", time_of([&] { euler.first_order_jacobian(q, frames(), 0.5, mass, jacobian); }, 5));
    for (const int levels : {0, 1}) {
      Handle<PC, PCDestroy> pc;
      petsc(PCCreate(PETSC_COMM_WORLD, pc.out()));
      petsc(PCSetOperators(pc, jacobian.matrix(), jacobian.matrix()));
      preconditioner("ilu").set_up(pc, levels, nullptr);
      const std::string name = "(ilu, " + std::to_string(levels) + " levels of fill)";
      report("preconditioner set-up " + name, time_of([&] {
               petsc(MatAssemblyBegin(jacobian.matrix(), MAT_FINAL_ASSEMBLY));  // marks it as new
               petsc(MatAssemblyEnd(jacobian.matrix(), MAT_FINAL_ASSEMBLY));
               petsc(PCSetUp(pc));
             }, 5));
      report("preconditioner application " + name, time_of([&] { petsc(PCApply(pc, dq, out)); }, 15));
    }
  }

  void step() {
    const double loaded = memory_in_use();
    EulerOperator euler(mesh_, model(Reconstruction::linear));
    FlowOptions options;
    {
      FlowOptions plain = options;
      plain.scheme = &time_scheme("ssp_rk3");
      FlowSolver solver(euler, plain);
      petsc(VecCopy(start(euler), solver.state().q));
      solver.advance([this](double) { return frames(); }, 1e-6);
      petsc(PetscPrintf(PETSC_COMM_WORLD, "%-40s %8.0f bytes/cell\n", (name_ + "/memory explicit").c_str(),
                        (memory_in_use() - before_) / mesh_.n_global));
    }
    FlowSolver solver(euler, options);
    petsc(VecCopy(start(euler), solver.state().q));
    const double dt = 20 / euler.courant_number(solver.state().q, frames(), 1.0);
    StepReport last;
    const Timing t = time_of([&] { last = solver.advance([this](double) { return frames(); }, dt); }, 7);
    report("step crank_nicolson Courant 20", t, {{"newton", last.newton()}, {"krylov", last.krylov()}});
    petsc(PetscPrintf(PETSC_COMM_WORLD, "%-40s %8.0f bytes/cell (mesh and PETSc alone: %.0f)\n",
                      (name_ + "/memory implicit").c_str(), (memory_in_use() - before_) / mesh_.n_global,
                      (loaded - before_) / mesh_.n_global));
  }

  std::string name_;
  double before_;
  mesh::Mesh mesh_;
  int ranks_ = 1;
  double bandwidth_ = 0;
  nlohmann::ordered_json results_ = nlohmann::ordered_json::array();
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: windhover_bench MESH NAME JSON_OUT\n");
    return 2;
  }
  use_large_pages(argv);
  PetscInitialize(nullptr, nullptr, nullptr, nullptr);
  {
    const auto results = Bench(argv[1], argv[2]).run();
    int rank = 0;
    MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
    if (rank == 0) std::ofstream(argv[3]) << results.dump(2) << "\n";
  }
  PetscFinalize();
}
