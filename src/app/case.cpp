#include "app/case.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/case_keys.h"
#include "app/rotors.h"
#include "app/vehicle.h"
#include "base/errors.h"
#include "base/version.h"
#include "io/options_documenter.h"
#include "io/options_reader.h"
#include "io/options_writer.h"

namespace windhover::app {
namespace {

namespace fs = std::filesystem;

constexpr double radians = std::numbers::pi / 180;
constexpr const char* kClock = "the clock starts at 0, where it would be elsewhere";

std::string case_name(const fs::path& file) {
  return file.filename() == "case.toml" ? file.parent_path().filename().string() : file.stem().string();
}

/// <geometry>_<k1><v1>_<k2><v2>.msh beside the geometry: each set of parameters has a mesh of its own.
fs::path mesh_of_geometry(const MeshOptions& mesh) {
  const fs::path geometry = mesh.geometry;
  std::string name = geometry.stem().string();
  for (const auto& [key, value] : mesh.parameters) name += fmt::format("_{}{}", key, value);
  return geometry.parent_path() / (name + ".msh");
}

void complete(Case& c) {
  const fs::path folder = c.file.parent_path();
  auto& mesh = c.mesh;
  if (!mesh.geometry.empty()) mesh.geometry = (folder / mesh.geometry).lexically_normal();
  if (!mesh.file.empty()) {
    mesh.file = (folder / mesh.file).lexically_normal();
  } else if (!mesh.geometry.empty()) {
    mesh.file = mesh_of_geometry(mesh);
  }
  complete_rotors(c);
  for (auto& zone : c.zone) {
    if (zone.inner_surface.empty()) zone.inner_surface = zone.name + "_slide";
    if (zone.outer_surface.empty()) zone.outer_surface = zone.inner_surface;
  }
  if (c.body.walls.empty()) {
    for (const auto& [name, condition] : c.fluid.boundary)
      if (condition == "wall") c.body.walls.push_back(name);
  }
  if (c.output.directory.empty()) c.output.directory = "results/" + c.name;
}

void validate_time(const Case& c, const toml::table& file) {
  const TimeOptions& time = c.time;
  const int step_keys = int(time.step_s.has_value()) + time.step_deg.has_value() + time.step_nondim.has_value();
  if (step_keys != 1)
    throw UserError("{}: time: exactly one of step_s, step_deg, step_nondim is needed, {} are given",
                    io::place(file, "time"), step_keys);
  if (time.steps.has_value() == time.end_s.has_value())
    throw UserError("{}: time: exactly one of steps and end_s is needed, {} given", io::place(file, "time"),
                    time.steps ? "both are" : "none is");
  if (time.step_deg && fastest_rotation_deg_s(c) == 0)
    throw UserError("{}: time.step_deg = {}: needs a [[rotor]], a [[zone]] or a [[body.motion]] of kind \"rotation\" that turns",
                    io::place(file, "time.step_deg"), *time.step_deg);
}

/// A flow that has begun elsewhere fits a vehicle that it brings along, but no motion that time alone prescribes.
void validate_start(const Case& c, const toml::table& file) {
  if (c.time.start_from.empty()) return;
  const std::string at = io::place(file, "time.start_from");
  if (const ZoneOptions* zone = zone_turned_by_time(c))
    throw UserError("{}: time.start_from: \"{}\" turns as prescribed: {}", at, zone->name, kClock);
  for (size_t i = 0; !is_dynamic(c) && i < c.body.motion.size(); ++i) {
    const MotionOptions& m = c.body.motion[i];
    if (m.amplitude_m != 0 || m.amplitude_deg != 0 || m.rate_deg_s != 0)
      throw UserError("{}: time.start_from: body.motion[{}] moves the body as prescribed: {}", at, i, kClock);
  }
}

void validate_resolution(const MeshOptions& mesh, const toml::table& file) {
  if (mesh.resolution.empty() || mesh.resolutions.contains(mesh.resolution)) return;
  std::vector<std::string> names;
  for (const auto& [name, refine] : mesh.resolutions) names.push_back(name);
  throw UserError("{}: mesh.resolution = \"{}\": is not in mesh.resolutions{}", io::place(file, "mesh.resolution"),
                  mesh.resolution, suggestion(mesh.resolution, names));
}

void validate_direction(const Vec3& direction, const std::string& key, const toml::table& file) {
  if (direction.norm() == 0) throw UserError("{}: {} = [0, 0, 0]: has no direction", io::place(file, key), key);
}

void validate(const Case& c, const toml::table& file) {
  if (c.mesh.file.empty())
    throw UserError("{}: mesh: one of mesh.file, mesh.geometry, [airframe] and a [[rotor]] with blades is needed", io::place(file, "mesh"));
  if (!c.mesh.parameters.empty() && c.mesh.geometry.empty())
    throw UserError("{}: mesh.parameters: is of no use without mesh.geometry", io::place(file, "mesh.parameters"));
  for (const auto& name : c.body.walls) {
    if (is_wall(c, name)) continue;
    std::vector<std::string> walls;
    for (const auto& [surface, condition] : c.fluid.boundary)
      if (condition == "wall") walls.push_back(surface);
    throw UserError("{}: body.walls: \"{}\" is not a wall in [fluid.boundary]{}", io::place(file, "body.walls"), name,
                    suggestion(name, walls));
  }
  validate_direction(c.fluid.initial.direction, "fluid.initial.direction", file);
  for (size_t i = 0; i < c.body.motion.size(); ++i) {
    validate_direction(c.body.motion[i].direction, fmt::format("body.motion[{}].direction", i), file);
    validate_direction(c.body.motion[i].axis, fmt::format("body.motion[{}].axis", i), file);
  }
  for (size_t i = 0; i < c.zone.size(); ++i) {
    const ZoneOptions& zone = c.zone[i];
    const std::string key = fmt::format("zone[{}]", i);
    if (zone.name.empty() || zone.parent.empty())
      throw UserError("{}: {}: name and parent are needed", io::place(file, key), key);
    validate_direction(zone.axis, key + ".axis", file);
  }
  for (size_t i = 0; i < c.wind.change.size(); ++i)
    if (c.wind.change[i].kind == "gust" && c.wind.change[i].duration_s == 0)
      throw UserError("{}: wind.change[{}].duration_s = 0: must be > 0 for a gust", io::place(file, "wind.change"), i);
  validate_vehicle(c, file);
  validate_time(c, file);
  validate_start(c, file);
  constexpr double most_steps = 1e9;
  if (c.time.end_s && *c.time.end_s / step_seconds(c) > most_steps)
    throw UserError("{}: time.end_s = {}: is more than {} steps of {} s", io::place(file, "time.end_s"), *c.time.end_s,
                    most_steps, step_seconds(c));
}

/// The keys of another case file with those of this one over them.
toml::table lay_over(const std::string& like, const fs::path& file, toml::table& keys) {
  if (fs::path(like).has_parent_path())
    throw UserError("{}: like = \"{}\": must be a file in the folder of this one", io::place(keys, "like"), like);
  toml::table root = io::read_toml(file.parent_path() / like);
  if (root.contains("like")) throw UserError("{}: like: this file is itself like another", io::place(root, "like"));
  keys.erase("like");
  io::merge(root, keys);
  return root;
}

}  // namespace

bool is_wall(const Case& c, const std::string& surface) {
  const auto there = c.fluid.boundary.find(surface);
  return there != c.fluid.boundary.end() && there->second == "wall";
}

Case load_case(const fs::path& file, const std::vector<std::string>& overrides) {
  Case c;
  c.file = fs::absolute(file).lexically_normal();
  c.name = c.mesh_name = case_name(c.file);
  toml::table root = io::read_toml(file, overrides);
  if (const auto like = root["like"].value<std::string>(); like && !like->empty()) {
    c.mesh_name = case_name(c.file.parent_path() / *like);
    root = lay_over(*like, c.file, root);
  }
  copy_like_rotors(root);
  io::read_options(root, c);
  validate_resolution(c.mesh, root);
  complete(c);
  validate_rotors(c, root);
  complete_vehicle(c);
  validate(c, root);
  return c;
}

std::string effective_case(const Case& effective) {
  Case c = effective;
  remove_rotor_zones(c);
  return fmt::format("# {}: the effective case, written by windhover {} ({})\n{}", c.name, version, revision,
                     io::options_text(c));
}

std::string case_file_documentation() {
  return "# Keys of a case file\n\n"
         "Generated from the declarations by `windhover keys`. Everything is in SI, with the unit in the key's name.\n" +
         io::options_documentation<Case>();
}

mesh::Motion body_motion(const Case& c) {
  mesh::Motion motion;
  for (const auto& o : c.body.motion) {
    const double omega = 2 * std::numbers::pi * o.frequency_hz, phase = o.phase_deg * radians;
    if (o.kind == "translation") {
      motion.push_back(
          mesh::Translation{o.direction.normalized(), {o.mean_m, o.rate_m_s, o.amplitude_m, omega, phase}});
    } else {
      motion.push_back(
          mesh::Rotation{o.axis.normalized(),
                         o.point_m,
                         {o.mean_deg * radians, o.rate_deg_s * radians, o.amplitude_deg * radians, omega, phase}});
    }
  }
  return motion;
}

mesh::Rotation zone_rotation(const ZoneOptions& zone) {
  return {zone.axis.normalized(),
          zone.point_m,
          {zone.mean_deg * radians, zone.rate_deg_s * radians, zone.amplitude_deg * radians,
           2 * std::numbers::pi * zone.frequency_hz, zone.phase_deg * radians}};
}

double fastest_rotation_deg_s(const Case& c) {
  double fastest = 0;
  for (const auto& motion : c.body.motion)
    if (motion.kind == "rotation") fastest = std::max(fastest, std::abs(motion.rate_deg_s));
  for (const auto& zone : c.zone) fastest = std::max(fastest, std::abs(zone.rate_deg_s));
  return fastest;
}

double step_seconds(const Case& c) {
  if (c.time.step_s) return *c.time.step_s;
  if (c.time.step_deg) return *c.time.step_deg / fastest_rotation_deg_s(c);
  return *c.time.step_nondim * c.fluid.length_m / c.fluid.sound_speed_m_s;
}

double end_seconds(const Case& c) { return c.time.end_s ? *c.time.end_s : *c.time.steps * step_seconds(c); }

int step_count(const Case& c) {
  if (c.time.steps) return *c.time.steps;
  return static_cast<int>(std::ceil(*c.time.end_s / step_seconds(c) * (1 - 1e-12)));
}

std::optional<double> turn_seconds(const Case& c) {
  const double fastest = fastest_rotation_deg_s(c);
  if (fastest == 0) return {};
  return 360 / fastest;
}

}  // namespace windhover::app
