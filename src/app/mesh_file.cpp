#include "app/mesh_file.h"

#include <algorithm>
#include <array>
#include <csignal>
#include <regex>
#include <sstream>

#include "app/process.h"
#include "base/errors.h"
#include "base/options.h"
#include "io/file.h"
#include "geometry/rotor_keys.h"
#include "io/options_reader.h"
#include "io/options_writer.h"
#include "mesh/mesh.h"
#include "mesh/quality.h"

namespace windhover::app {
namespace {

namespace fs = std::filesystem;

/// The parameters that a geometry lets us set: those of its DefineConstant lists.
std::vector<std::string> geometry_parameters(const std::string& geometry) {
  std::vector<std::string> names;
  const std::regex list("DefineConstant\\s*\\[([^\\]]*)\\]"), entry("([A-Za-z_]\\w*)\\s*=");
  for (std::sregex_iterator found(geometry.begin(), geometry.end(), list), end; found != end; ++found) {
    const std::string body = (*found)[1];
    for (std::sregex_iterator name(body.begin(), body.end(), entry); name != end; ++name) names.push_back((*name)[1]);
  }
  return names;
}

/// gmsh itself ignores a number that nothing uses.
void validate_parameters(const MeshOptions& mesh) {
  const auto valid = geometry_parameters(io::read_text(mesh.geometry));
  for (const auto& [name, value] : mesh.parameters)
    if (std::find(valid.begin(), valid.end(), name) == valid.end())
      throw UserError("{}: has no DefineConstant \"{}\", given in mesh.parameters{}", mesh.geometry, name,
                      suggestion(name, valid));
}

std::string error_lines(const std::string& log) {
  std::istringstream text(log);
  std::string errors;
  for (std::string line; std::getline(text, line);)
    if (line.starts_with("Error")) errors += "\n  " + line;
  return errors;
}

void print_worst(const char* name, const mesh::Worst& worst, const char* unit) {
  fmt::print("  {:<34} {:.3g} {} at ({:.4g}, {:.4g}, {:.4g}) m\n", name, worst.value, unit, worst.place[0],
             worst.place[1], worst.place[2]);
}

/// What the mesh is made from, and the record of it beside the mesh. Files in it are relative to the record, so that it holds
/// from wherever it is read.
std::string geometry_text(const Case& c) {
  geometry::GeometryOptions geometry = mesh_geometry(c);
  const fs::path folder = fs::absolute(c.mesh.file).parent_path();
  const auto make_relative = [&](std::string& file) {
    if (fs::is_regular_file(file)) file = fs::proximate(file, folder);
  };
  make_relative(geometry.airframe.step);
  for (auto& rotor : geometry.rotor) {
    make_relative(rotor.blade.airfoil);
    for (auto& section : rotor.blade.section) make_relative(section.airfoil);
  }
  for (auto& rotor : geometry.rotor) rotor.rpm = rotor.mass_kg = 0;  // the mesh does not depend on them
  for (auto& part : geometry.airframe.part) part.mass_kg = part.density_kg_m3 = 0;
  return io::options_text(geometry);
}
std::string record_of(const Case& c) { return c.mesh.file + ".toml"; }

/// Keys that a record does not have yet count with their defaults.
std::string text_of_record(const std::string& file) {
  try {
    geometry::GeometryOptions geometry;
    io::read_options(io::read_toml(file), geometry);
    return io::options_text(geometry);
  } catch (const UserError&) {
    return "";  // of other keys
  }
}

bool is_other_geometry(const Case& c) {
  return is_made_from_parts(c) && (!fs::exists(record_of(c)) || text_of_record(record_of(c)) != geometry_text(c));
}

std::vector<std::string> mesher_command(const Case& c, const std::string& output, double finer) {
  if (is_made_from_parts(c)) {
    io::write_atomically(record_of(c), geometry_text(c));
    return {fs::path(own_path()).replace_filename("windhover-mesher"), record_of(c), output,
            fmt::format("{}", finer)};
  }
  validate_parameters(c.mesh);
  std::vector<std::string> command = {"gmsh", c.mesh.geometry, "-3", "-format", "msh41", "-o", output};
  for (const auto& [name, value] : c.mesh.parameters)
    command.insert(command.end(), {"-setnumber", name, fmt::format("{}", value)});
  return command;
}

/// No run may take the mesh; a made one stays under another name, to be looked at.
void refuse(const Case& c, const char* what, const mesh::Worst& worst, const char* key, double limit) {
  if (can_make_mesh(c)) fs::rename(c.mesh.file, c.mesh.file + ".refused");
  throw UserError("{}: {} {:.3g} at ({:.4g}, {:.4g}, {:.4g}) m is below {} = {:.3g}: Newton would stall", c.mesh.file, what,
                  worst.value, worst.place[0], worst.place[1], worst.place[2], key, limit);
}

}  // namespace

bool can_make_mesh(const Case& c) { return is_made_from_parts(c) || !c.mesh.geometry.empty(); }

bool mesh_is_due(const Case& c) {
  std::error_code missing;
  const auto made = fs::last_write_time(c.mesh.file, missing);
  if (missing || is_other_geometry(c)) return true;
  return !c.mesh.geometry.empty() && fs::exists(c.mesh.geometry) && fs::last_write_time(c.mesh.geometry) > made;
}

void require_mesh(const Case& c) {
  if (!fs::exists(c.mesh.file))
    throw UserError("{}: mesh.file: {} does not exist{}", c.file.string(), c.mesh.file,
                    can_make_mesh(c) ? "; `windhover mesh` with the same arguments makes it" : "");
  if (is_other_geometry(c))
    throw UserError("{}: {} was made from other [airframe], [[rotor]] or mesh keys; `windhover mesh` with the same arguments makes it anew",
                    c.file.string(), c.mesh.file);
}

void make_mesh(const Case& c) {
  const std::string temporary = c.mesh.file + ".tmp.msh", log = c.mesh.file + ".log";
  io::make_folder(fs::path(c.mesh.file).parent_path());
  std::error_code ignored;
  fs::remove(temporary, ignored);
  fs::remove(c.mesh.file, ignored);
  int code = run_process(mesher_command(c, temporary, 1), {log, log});
  for (const double finer : {1.01, 1.02, 1.03}) {  // gmsh's HXT crashes now and then: on sizes a little smaller not
    if (code <= 128 || code == 128 + SIGINT || code == 128 + SIGTERM || !is_made_from_parts(c)) break;
    fmt::print("gmsh crashed; once more with all sizes divided by {}\n", finer);
    code = run_process(mesher_command(c, temporary, finer), {log, log});
  }
  const std::string errors = error_lines(io::read_text(log));
  if (code != 0 || !errors.empty() || !fs::exists(temporary)) {
    fs::remove(temporary, ignored);
    constexpr int user_error = 2;
    if (is_made_from_parts(c) && code == user_error) throw UserError("{}: the mesh cannot be made:{}", c.file.string(), errors);
    throw UserError("{}: gmsh failed (exit code {}); its messages are in {}{}",
                    is_made_from_parts(c) ? c.file.string() : c.mesh.geometry, code, log, errors);
  }
  io::publish(temporary, c.mesh.file);
  fs::remove(log, ignored);
}

void report_mesh(const Case& c) {
  const mesh::Mesh m = mesh::read_mesh(c.mesh.file, c.mesh.scale_m, PETSC_COMM_WORLD);
  const std::array<std::pair<mesh::CellType, const char*>, 4> types = {{{mesh::CellType::tetrahedron, "tetrahedra"},
                                                                        {mesh::CellType::pyramid, "pyramids"},
                                                                        {mesh::CellType::prism, "prisms"},
                                                                        {mesh::CellType::hexahedron, "hexahedra"}}};
  fmt::print("{}\n  {} cells:", c.mesh.file, m.n_global);
  for (const auto& [type, name] : types)
    if (const auto count = std::count(m.type.begin(), m.type.begin() + m.n_owned, type); count > 0)
      fmt::print(" {} {}", count, name);
  fmt::print("\n  zones:");
  for (size_t z = 0; z < m.zones.size(); ++z)
    fmt::print(" {} ({})", m.zones[z].name, std::count(m.cell_zone.begin(), m.cell_zone.begin() + m.n_owned, z));
  fmt::print("\n  surfaces:");
  for (const auto& patch : m.patches) fmt::print(" {}", patch.name);
  const mesh::Quality quality = mesh::measure_quality(m);
  fmt::print("\n");
  print_worst("shortest edge", quality.smallest_edge, "m");
  print_worst("smallest dihedral angle", quality.smallest_dihedral_deg, "deg");
  print_worst("largest volume ratio of neighbours", quality.largest_volume_ratio, "");
  print_worst("smallest cell, root of volume", quality.smallest_cell, "m");
  fmt::print("  sound crosses the smallest cell in {:.3g} s\n", quality.smallest_cell.value / c.fluid.sound_speed_m_s);
  if (quality.smallest_edge.value < c.mesh.min_edge_m)
    refuse(c, "shortest edge", quality.smallest_edge, "mesh.min_edge_m", c.mesh.min_edge_m);
  if (quality.smallest_dihedral_deg.value < c.mesh.min_dihedral_deg)
    refuse(c, "smallest dihedral angle", quality.smallest_dihedral_deg, "mesh.min_dihedral_deg", c.mesh.min_dihedral_deg);
}

}  // namespace windhover::app
