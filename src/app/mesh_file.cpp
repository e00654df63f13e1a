#include "app/mesh_file.h"

#include <algorithm>
#include <array>
#include <regex>
#include <sstream>

#include "app/process.h"
#include "base/errors.h"
#include "base/options.h"
#include "io/file.h"
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

}  // namespace

bool mesh_is_due(const Case& c) {
  std::error_code missing;
  const auto made = fs::last_write_time(c.mesh.file, missing);
  if (missing) return true;
  return !c.mesh.geometry.empty() && fs::exists(c.mesh.geometry) && fs::last_write_time(c.mesh.geometry) > made;
}

void require_mesh(const Case& c) {
  if (fs::exists(c.mesh.file)) return;
  throw UserError("{}: mesh.file: {} does not exist{}", c.file.string(), c.mesh.file,
                  c.mesh.geometry.empty() ? "" : "; `windhover mesh` with the same arguments makes it");
}

void make_mesh(const Case& c) {
  validate_parameters(c.mesh);
  const std::string temporary = c.mesh.file + ".tmp", log = c.mesh.file + ".log";
  std::vector<std::string> command = {"gmsh", c.mesh.geometry, "-3", "-format", "msh41", "-o", temporary};
  for (const auto& [name, value] : c.mesh.parameters)
    command.insert(command.end(), {"-setnumber", name, fmt::format("{}", value)});
  io::make_folder(fs::path(c.mesh.file).parent_path());
  std::error_code ignored;
  fs::remove(temporary, ignored);
  const int code = run_process(command, {log, log});
  const std::string errors = error_lines(io::read_text(log));
  if (code != 0 || !errors.empty() || !fs::exists(temporary)) {
    fs::remove(temporary, ignored);
    throw UserError("{}: gmsh failed (exit code {}); its messages are in {}{}", c.mesh.geometry, code, log, errors);
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
  for (const auto& zone : m.zones) fmt::print(" {}", zone.name);
  fmt::print("\n  surfaces:");
  for (const auto& patch : m.patches) fmt::print(" {}", patch.name);
  const mesh::Quality quality = mesh::measure_quality(m);
  fmt::print("\n");
  print_worst("shortest edge", quality.smallest_edge, "m");
  print_worst("smallest dihedral angle", quality.smallest_dihedral_deg, "deg");
  print_worst("largest volume ratio of neighbours", quality.largest_volume_ratio, "");
}

}  // namespace windhover::app
