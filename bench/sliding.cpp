// What the sliding interfaces of a case cost in a step, backward Euler with the case's time step.
// Usage: windhover_bench_sliding CASE.toml NAME JSON_OUT [key=value ...]
#include <algorithm>
#include <ctime>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "app/flow_setup.h"
#include "app/zone_tree.h"
#include "base/memory.h"

using namespace windhover;
using namespace windhover::fluid;

namespace {

/// Of the processor: other programs that run at the same time count less.
double now() {
  timespec t = {};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

double seconds(const std::function<void()>& work) {
  MPI_Barrier(PETSC_COMM_WORLD);
  const double start = now();
  work();
  double s = now() - start;
  MPI_Allreduce(MPI_IN_PLACE, &s, 1, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD);
  return s;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

class SlidingBench {
 public:
  explicit SlidingBench(const app::Case& c)
      : zoned_(app::read_zones(c, PETSC_COMM_WORLD)),
        tree_(c, zoned_.mesh),
        step_(app::step_seconds(c) / app::Scales(c.fluid).time()),
        options_(app::flow_options(c)),
        with_(zoned_.mesh, app::flow_model(c), zoned_.interfaces),
        without_(zoned_.mesh, walls_instead(c), {}),
        q_(with_.make_vector()) {
    options_.scheme = &time_scheme("backward_euler");
    set_initial(with_, tree_.frames(0), app::initial_state(c), q_);
  }

  nlohmann::ordered_json run(const std::string& name) {
    const mesh::Mesh& mesh = zoned_.mesh;
    SlidingFaces faces(mesh, zoned_.interfaces);
    size_t n_faces = 0;
    for (const auto& interface : zoned_.interfaces) n_faces += interface.faces(0).size() + interface.faces(1).size();
    std::vector<double> geometry;
    for (int i = 1; i <= 15; ++i) geometry.push_back(seconds([&] { faces.faces(tree_.frames(i * step_)); }));
    const Frames start = tree_.frames(0);
    const VecHandle out = with_.make_vector();
    with_.linearize(q_, start);
    without_.linearize(q_, start);
    const double residual = added([&](EulerOperator& e) { e.residual(q_, start, out); });
    const double product = added([&](EulerOperator& e) { e.derivative(q_, out, {}, {}, true); });

    FlowSolver solver(with_, options_);
    petsc(VecCopy(q_, solver.state().q));
    std::vector<double> steps;
    StepReport last;
    for (int i = 0; i < 8; ++i)
      steps.push_back(seconds([&] { last = solver.advance([this](double t) { return tree_.frames(t); }, step_); }));
    steps.erase(steps.begin());  // it has no first guess to extrapolate from
    // one new place of the zones, a residual per Newton iteration and one at the start, a product per Krylov iteration
    const double step = median(steps), pieces = median(geometry);
    const double fluxes = (last.newton() + 1) * residual + last.krylov() * product;
    int ranks = 1;
    MPI_Comm_size(PETSC_COMM_WORLD, &ranks);
    long zone_cells = 0;
    for (const auto& interface : zoned_.interfaces)
      zone_cells += std::count(mesh.cell_zone.begin(), mesh.cell_zone.begin() + mesh.n_owned, interface.zone(0));
    MPI_Allreduce(MPI_IN_PLACE, &zone_cells, 1, MPI_LONG, MPI_SUM, PETSC_COMM_WORLD);
    return {{"name", name + "/sliding"},
            {"cells", mesh.n_global},
            {"zone_cells", zone_cells},
            {"interface_faces", n_faces},
            {"ranks", ranks},
            {"median", 1e6 * pieces / double(n_faces)},
            {"unit", "us per interface face: pieces of one position"},
            {"step_s", step},
            {"newton", last.newton()},
            {"krylov", last.krylov()},
            {"share_of_pieces", pieces / step},
            {"share_of_fluxes", fluxes / step}};
  }

 private:
  static FlowModel walls_instead(const app::Case& c) {
    FlowModel model = app::flow_model(c);
    for (const auto& zone : c.zone)
      for (const auto& surface : {zone.inner_surface, zone.outer_surface}) model.boundary[surface] = BoundaryKind::wall;
    return model;
  }
  /// By how much the interface's fluxes lengthen a piece of work: against walls in their place.
  double added(const std::function<void(EulerOperator&)>& work) {
    std::vector<double> difference;
    work(with_), work(without_);
    for (int i = 0; i < 31; ++i) {
      const double with = seconds([&] { work(with_); });
      difference.push_back(with - seconds([&] { work(without_); }));
    }
    return median(difference);
  }

  app::ZonedMesh zoned_;
  app::ZoneTree tree_;
  double step_;
  FlowOptions options_;
  EulerOperator with_, without_;
  VecHandle q_;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(stderr, "usage: windhover_bench_sliding CASE.toml NAME JSON_OUT [key=value ...]\n");
    return 2;
  }
  use_large_pages(argv);
  PetscInitialize(nullptr, nullptr, nullptr, nullptr);
  {
    const auto result = SlidingBench(app::load_case(argv[1], {argv + 4, argv + argc})).run(argv[2]);
    petsc(PetscPrintf(PETSC_COMM_WORLD,
                      "%-40s %8.4f us/interface face  zone of %ld cells, %d faces: pieces %.2f %%, fluxes %.2f %% of a step of %.3f s\n",
                      std::string(result["name"]).c_str(), double(result["median"]), long(result["zone_cells"]),
                      int(result["interface_faces"]), 100 * double(result["share_of_pieces"]),
                      100 * double(result["share_of_fluxes"]), double(result["step_s"])));
    int rank = 0;
    MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
    if (rank == 0) std::ofstream(argv[3]) << nlohmann::ordered_json::array({result}).dump(2) << "\n";
  }
  PetscFinalize();
}
