// windhover-mesher GEOMETRY.toml MESH.msh: `windhover mesh` runs it. A program of its own because gmsh's licence is the GPL.
#include <fmt/format.h>
#include <gmsh.h>

#include <exception>

#include "geometry/rotor_keys.h"
#include "io/options_reader.h"
#include "mesher/rotor_model.h"

int main(int argc, char** argv) {
  if (argc != 3) {
    fmt::print(stderr, "windhover-mesher GEOMETRY.toml MESH.msh\n");
    return 2;
  }
  try {
    windhover::geometry::GeometryOptions geometry;
    windhover::io::read_options(windhover::io::read_toml(argv[1]), geometry);
    gmsh::initialize();
    gmsh::option::setNumber("General.Terminal", 1);
    gmsh::option::setNumber("Mesh.MshFileVersion", 4.1);
    windhover::mesher::mesh_rotors(geometry);
    gmsh::write(argv[2]);
    gmsh::finalize();
    return 0;
  } catch (const std::exception& error) {
    fmt::print("Error: {}\n", error.what());
    return 1;
  } catch (const std::string& error) {  // gmsh throws the text of its last message
    fmt::print("Error: {}\n", error);
    return 1;
  }
}
