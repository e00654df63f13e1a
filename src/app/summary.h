// summary.json: what a run did and what it cost.
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/history.h"

namespace windhover::app {

class Summary {
 public:
  Summary(const Case& c, const mesh::Mesh& mesh) : case_(c), mesh_(mesh) {}

  void start(const fluid::FlowSolver& solver, double setup_s);
  /// `coupling`: iterations; 0 where there is no coupling.
  void step(const fluid::StepReport& report, int coupling, const fluid::FlowState& state, const Loads& loads,
            double seconds);
  void rejected() { ++rejected_; }
  void output(double seconds) { output_s_ += seconds; }
  void write(const std::filesystem::path& directory, const fluid::FlowSolver& solver, const nlohmann::ordered_json& rotors,
             const nlohmann::ordered_json& momentum, double wall_s) const;

 private:
  const Case& case_;
  const mesh::Mesh& mesh_;
  long first_step_ = 0;
  double mass_ = 0;  ///< at the start of this run
  double memory_ = 0;  ///< of this rank after the first step, bytes
  double setup_s_ = 0, solve_s_ = 0, output_s_ = 0;
  long rejected_ = 0, newton_ = 0, krylov_ = 0, coupling_ = 0, averaged_ = 0;
  Loads sum_;
};

}  // namespace windhover::app
