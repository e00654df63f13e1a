// The tables of a run's rotors (docs/results.md), and what their averages need to survive a restart.
#pragma once
#include <nlohmann/json.hpp>

#include "app/blade_pressures.h"
#include "app/blade_strips.h"
#include "app/revolution_mean.h"
#include "fluid/flow_solver.h"
#include "io/csv.h"

namespace windhover::app {

class RotorOutput {
 public:
  /// `last_step`: continue the tables from there. Collective.
  RotorOutput(const Case& c, const mesh::Mesh& mesh, const std::filesystem::path& directory,
              std::optional<std::int64_t> last_step);

  /// Once for the initial state and each accepted step, with its fluxes: the loads of each rotor. Writes the rows of
  /// revolutions that are complete. Collective.
  std::vector<RotorLoads> step(fluid::FlowSolver& solver, const std::vector<fluid::PatchFlux>& fluxes, const fluid::Frames& frames);

  /// Rows of the strips and sections at the latest step. Collective.
  void write();

  /// Each rotor's latest revolution, for summary.json.
  nlohmann::ordered_json summary() const;

  /// What a restart needs, the same on all ranks. UserError when it is of other rotors, strips or sections.
  std::vector<double> state() const;
  void restore(std::span<const double> state);

 private:
  /// A table of the values at a step, and one of their means over revolutions.
  struct Tables {
    Tables(const std::filesystem::path& directory, const std::string& name, const std::vector<std::string>& columns, MPI_Comm comm,
           std::optional<std::int64_t> last_step);
    io::CsvTable now, mean;
  };
  struct Rotor {
    MeshRotor rotor;
    io::CsvTable revolutions;
    std::optional<BladeStrips> strips;
    std::optional<BladePressures> pressures;
    std::optional<Tables> strip_tables, pressure_tables;
    RevolutionMean mean;
    double angle_deg = 0;  ///< at the latest step
  };
  void add_rotor(const MeshRotor& rotor, const mesh::Mesh& mesh, const std::filesystem::path& directory,
                 std::optional<std::int64_t> last_step);
  void add_surface_values(size_t rotor, double rpm, std::span<const std::vector<fluid::State<double>>> states,
                          std::vector<double>& values) const;
  std::vector<double> revolution_row(const Rotor& rotor, const Revolution& revolution) const;
  void write_surface(Rotor& rotor, bool mean, double time_s, std::span<const double> values);

  const Case& case_;
  MPI_Comm comm_;
  std::vector<Rotor> rotors_;
  std::vector<fluid::SurfacePoints> points_;  ///< of each rotor its blades' faces, then its sections
  std::int64_t step_ = -1;
  double time_s_ = 0;
  bool written_ = true;
};

}  // namespace windhover::app
