// The state of a run in a checkpoint, and back.
#pragma once
#include <filesystem>

#include "app/scales.h"
#include "fluid/flow_solver.h"
#include "io/row_exchange.h"

namespace windhover::app {

/// What else a run must remember, the same on every rank.
struct Memory {
  std::vector<double> averages;  ///< of the rotors
  std::vector<double> vehicle;   ///< body, motors, controller and coupling
  std::vector<double> step;      ///< control of the step size
};

/// Cells are stored in the mesh file's order, so a run may continue on any number of ranks.
class FlowCheckpoint {
 public:
  FlowCheckpoint(const Case& c, const mesh::Mesh& mesh);

  void write(const std::filesystem::path& directory, const fluid::FlowState& state, const fluid::Frames& frames,
             const Memory& memory) const;

  /// The newest checkpoint of the results. UserError: none, cut short, or of another mesh or scheme.
  Memory read(const std::filesystem::path& directory, fluid::FlowState& state) const;

 private:
  std::vector<double> rows_of(Vec q) const;
  void set_items(std::span<const double> rows, Vec q) const;

  const Case& case_;
  const mesh::Mesh& mesh_;
  io::RowExchange order_;
};

}  // namespace windhover::app
