// Rows of history.csv and solver.csv (columns: docs/results.md).
#pragma once
#include "app/rotor_loads.h"
#include "fluid/flow_solver.h"
#include "io/csv.h"

namespace windhover::app {

/// The columns of history.csv.
std::vector<std::string> history_columns(const Case& c);

/// Attitude of a body with axes x forward, y up, z right, in degrees: yaw about y (positive clockwise from above),
/// then pitch about z (nose up), then roll about x (right wing down).
struct Attitude {
  double roll_deg, pitch_deg, yaw_deg;
};
Attitude attitude(const mesh::Mat3& R);

/// Force on the case's walls, of one flux per patch, and its moment about a point (nondimensional, inertial), SI, inertial axes.
struct Loads {
  Vec3 force_N = Vec3::Zero(), moment_Nm = Vec3::Zero();
};
Loads wall_loads(const Case& c, const std::vector<mesh::Patch>& patches, const std::vector<fluid::PatchFlux>& fluxes,
                 const Vec3& point);

/// What an accepted step adds to the histories besides the state itself.
struct StepRecord {
  fluid::StepReport report;
  double wall_s = 0;
  std::vector<RotorLoads> rotors;  ///< of each with blades
  int coupling_iterations = 0;
};

class History {
 public:
  History(const Case& c, const std::filesystem::path& directory, MPI_Comm comm, std::optional<std::int64_t> last_step);

  /// The row of the current state, with its fluxes; returns the loads written.
  Loads append(fluid::FlowSolver& solver, const mesh::FrameState& body, const std::vector<fluid::PatchFlux>& fluxes,
               const StepRecord& record);

 private:
  const Case& case_;
  io::CsvTable history_, solver_;
};

}  // namespace windhover::app
