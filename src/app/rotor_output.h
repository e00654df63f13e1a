// The tables of a run's rotors (docs/results.md), and what their averages need to survive a restart.
#pragma once
#include <nlohmann/json.hpp>

#include "app/revolution_mean.h"
#include "app/rotor_loads.h"
#include "io/csv.h"

namespace windhover::app {

class RotorOutput {
 public:
  /// `last_step`: continue the tables from there. Collective.
  RotorOutput(const Case& c, const mesh::Mesh& mesh, const std::filesystem::path& directory,
              std::optional<std::int64_t> last_step);

  /// Once for the initial state and each accepted step: the loads of each rotor; rows of revolutions that are complete.
  /// Collective.
  std::vector<RotorLoads> step(std::int64_t step, double time_s, const std::vector<fluid::PatchFlux>& fluxes,
                               const fluid::Frames& frames);

  /// Each rotor's latest revolution, for summary.json.
  nlohmann::ordered_json summary() const;

  /// What a restart needs, the same on all ranks. UserError when it is of other rotors.
  std::vector<double> state() const;
  void restore(std::span<const double> state);

 private:
  struct Output {
    MeshRotor rotor;
    io::CsvTable revolutions;
    RevolutionMean mean;
    double angle_deg = 0;  ///< at the latest step
  };
  std::vector<double> revolution_row(const Output& output, const Revolution& revolution) const;

  const Case& case_;
  std::vector<Output> outputs_;
};

}  // namespace windhover::app
