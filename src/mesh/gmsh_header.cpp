#include "mesh/gmsh_header.h"

#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>

#include "base/errors.h"

namespace windhover::mesh {
namespace {

void read_format(std::istream& in, const std::string& file, GmshHeader& header) {
  std::string line;
  std::getline(in, line);
  if (!line.starts_with("$MeshFormat")) throw UserError("{}: not a gmsh mesh (it does not begin with $MeshFormat)", file);
  double version = 0;
  int binary = 0;
  if (!(in >> version >> binary)) throw UserError("{}: damaged gmsh mesh: unreadable $MeshFormat", file);
  if (version != 2.2 && version != 4.0 && version != 4.1)
    throw UserError("{}: gmsh mesh of version {}; readable are 2.2, 4.0 and 4.1", file, version);
  header.binary = binary != 0;
}

/// Text in binary files too: `dimension tag "name"` on each line.
void read_names(std::istream& in, const std::string& file, GmshHeader& header) {
  std::string line;
  std::getline(in, line);
  for (int count = std::atoi(line.c_str()); count > 0; --count) {
    std::getline(in, line);
    std::istringstream fields(line);
    int dimension = 0;
    PetscInt tag = 0;
    std::string name;
    if (!(fields >> dimension >> tag >> std::quoted(name)))
      throw UserError("{}: damaged gmsh mesh: unreadable line '{}' in $PhysicalNames", file, line);
    header.names[{dimension, tag}] = name;
  }
}

}  // namespace

std::string GmshHeader::name_of(int dimension, PetscInt tag) const {
  const auto found = names.find({dimension, tag});
  return found != names.end() ? found->second : std::to_string(tag);
}

GmshHeader read_gmsh_header(const std::string& file) {
  if (!std::filesystem::is_regular_file(file)) throw UserError("{}: no such mesh file", file);
  std::ifstream in(file, std::ios::binary);
  if (!in) throw UserError("{}: the mesh file cannot be opened for reading", file);
  GmshHeader header;
  read_format(in, file, header);
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("$PhysicalNames")) read_names(in, file, header);
    if (line.starts_with("$Entities") || line.starts_with("$Nodes")) break;
  }
  return header;
}

}  // namespace windhover::mesh
