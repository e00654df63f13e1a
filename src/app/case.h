// A case file as validated values: what load_case() returns is complete and consistent, nothing later checks it again.
#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "body/integrator.h"
#include "body/vehicle_options.h"
#include "control/control_options.h"
#include "coupling/coupling_options.h"
#include "coupling/trim_options.h"
#include "geometry/rotor_options.h"
#include "mesh/motion.h"

namespace windhover::app {

using Vec3 = Eigen::Vector3d;

struct MeshOptions {
  std::string file;      ///< after load_case: absolute, also when it follows from geometry and parameters
  std::string geometry;  ///< after load_case: absolute, or empty
  std::map<std::string, double> parameters;
  double scale_m = 1;
  double refine = 1;
  std::string resolution;
  std::map<std::string, double> resolutions;
  geometry::FarfieldOptions farfield;
  double min_dihedral_deg = 1, min_edge_m = 0;  ///< after load_case with rotors: min_edge_m follows from the smallest rotor

  /// What sizes are divided by: `refine` times that of the chosen resolution.
  double refinement() const { return resolution.empty() ? refine : refine * resolutions.at(resolution); }
};

/// State on one side of the initial jump; the velocity is along the jump's direction.
struct RiemannState {
  double density_kg_m3 = 1.225, velocity_m_s = 0, pressure_Pa = 101325;
};

struct InitialOptions {
  std::string kind = "uniform";
  Vec3 direction = Vec3::UnitX();
  double position_m = 0;
  RiemannState left, right;
  Vec3 center_m = Vec3::Zero();
  double strength = 5, core_radius_m = 1;
};

struct FluidOptions {
  double gamma = 1.4, density_kg_m3 = 1.225, sound_speed_m_s = 340.29, length_m = 1;
  std::string flux = "roe";
  bool low_mach = true;
  int order = 2;
  std::string gradient = "green_gauss";
  std::string limiter = "none";
  double limiter_epsilon = 0.01;
  std::map<std::string, std::string> boundary;  ///< condition of each physical surface
  InitialOptions initial;

  double pressure_Pa() const { return density_kg_m3 * sound_speed_m_s * sound_speed_m_s / gamma; }
};

struct WindChangeOptions {
  std::string kind = "ramp";
  double start_s = 0, duration_s = 0;
  Vec3 velocity_m_s = Vec3::Zero();
};

struct WindOptions {
  Vec3 velocity_m_s = Vec3::Zero();
  std::vector<WindChangeOptions> change;
};

/// One elementary prescribed motion; the keys of the other kind are unused.
struct MotionOptions {
  std::string kind = "translation";
  Vec3 direction = Vec3::UnitX();
  double mean_m = 0, rate_m_s = 0, amplitude_m = 0;
  Vec3 axis = Vec3::UnitZ(), point_m = Vec3::Zero();
  double mean_deg = 0, rate_deg_s = 0, amplitude_deg = 0;
  double frequency_hz = 0, phase_deg = 0;
};

/// A zone that turns inside another; zones without an entry move with the body.
struct ZoneOptions {
  std::string name, parent;  ///< physical volumes
  std::string shape = "cylinder";
  std::string inner_surface, outer_surface;  ///< after load_case: never empty
  Vec3 point_m = Vec3::Zero(), axis = Vec3::UnitY();
  double radius_m = 0, from_m = 0, to_m = 0;
  double mean_deg = 0, rate_deg_s = 0, amplitude_deg = 0, frequency_hz = 0, phase_deg = 0;
};

struct BodyOptions {
  std::vector<std::string> walls;  ///< after load_case: every wall when the file names none
  Vec3 moment_point_m = Vec3::Zero();
  std::string kind = "prescribed";
  std::vector<MotionOptions> motion;              ///< prescribed
  Vec3 center_of_gravity_m = Vec3::Zero();        ///< this and the rest: dynamic
  body::VehicleOptions vehicle;
  body::IntegratorOptions integrator;
};

/// What the controller knows of a rotor of the body.
struct RotorModelOptions {
  std::string name;
  std::optional<Vec3> position_m;
  Vec3 thrust_axis = Vec3::UnitY();
  double thrust_N_s2 = 0, torque_Nm_s2 = 0, min_speed_rad_s = 0, max_speed_rad_s = 0;
};

struct ControllerOptions {
  control::ControllerOptions law;
  std::vector<RotorModelOptions> rotor;
};

struct TimeOptions {
  std::string scheme = "crank_nicolson";
  std::optional<double> step_s, step_deg, step_nondim;  ///< exactly one
  std::optional<int> steps;                             ///< exactly one of steps and end_s
  std::optional<double> end_s;
  int start_steps = 0;
  double damping = 0.25;
  double first_step_ratio = 1;
  std::string start_from;  ///< results of another run; empty: none
};

struct SolverOptions {
  std::string method = "newton_krylov";
  std::string preconditioner = "ilu";
  int ilu_levels = 1;
  std::string jacobian = "exact";
  double newton_tolerance = 1e-3, truncation_fraction = 0;
  int newton_iterations = 12;
  int dual_time_iterations = 1000;
  double dual_time_cfl = 4;
  bool eisenstat_walker = true;
  double krylov_tolerance = 0.1;
  int krylov_iterations = 200, krylov_restart = 30;
  int jacobian_lag = 1;
  bool extrapolate = true;
  int max_halvings = 6;
};

struct OutputOptions {
  std::string directory;  ///< after load_case: never empty
  int fields_interval = 0, checkpoint_interval = 100;
  double average_from_s = 0;
  int span_strips = 20;
  std::vector<double> section_r_over_R;
};

struct Case {
  std::string name;            ///< the folder of a file called case.toml, otherwise the file's own name
  std::filesystem::path file;  ///< absolute
  std::string like;            ///< after load_case: empty
  std::string mesh_name;       ///< the name of the case that the mesh is named after
  MeshOptions mesh;
  FluidOptions fluid;
  WindOptions wind;
  BodyOptions body;
  geometry::AirframeOptions airframe;
  std::vector<geometry::RotorOptions> rotor;
  std::vector<ZoneOptions> zone;  ///< after load_case: those of rotors as well
  ControllerOptions controller;
  coupling::CouplingOptions coupling;
  coupling::TrimOptions trim;
  TimeOptions time;
  SolverOptions solver;
  OutputOptions output;
};

/// Reads, completes and validates a case file; overrides are `dotted.key=value`. UserError for anything wrong.
Case load_case(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

/// The effective case as TOML: every default written out, with the program's version.
std::string effective_case(const Case& c);

/// docs/case-file.md: every key with default, range and meaning.
std::string case_file_documentation();

/// A surface of the mesh that [fluid.boundary] calls a wall.
bool is_wall(const Case& c, const std::string& surface);

/// The prescribed motion of the root zone in SI units and radians.
mesh::Motion body_motion(const Case& c);

/// `windhover mesh` makes the mesh from [airframe] and [[rotor]], not from a .geo file.
bool is_made_from_parts(const Case& c);

/// The airframe and the rotors that it makes, with the ball around them.
geometry::GeometryOptions mesh_geometry(const Case& c);

/// How a zone turns in its parent, in SI units and radians.
mesh::Rotation zone_rotation(const ZoneOptions& zone);

/// The fastest steady rotation of body and zones; 0: nothing turns steadily.
double fastest_rotation_deg_s(const Case& c);

/// The length of a step and the end of the run in seconds; steps = end / step, rounded up.
double step_seconds(const Case& c);
double end_seconds(const Case& c);
int step_count(const Case& c);

/// One turn of the fastest steady rotation, which step_deg refers to; none where nothing turns.
std::optional<double> turn_seconds(const Case& c);

}  // namespace windhover::app
