// windhover-mesher GEOMETRY.toml MESH.msh FINER: `windhover mesh` runs it; FINER divides all sizes. A program of its own
// because gmsh's licence is the GPL.
#include <fmt/format.h>
#include <gmsh.h>
#include <sys/personality.h>
#include <unistd.h>

#include <exception>
#include <filesystem>

#include "base/errors.h"
#include "geometry/airframe.h"
#include "geometry/rotor.h"
#include "geometry/rotor_keys.h"
#include "io/options_reader.h"
#include "mesher/aircraft_model.h"

/// gmsh's meshes depend on the addresses of its objects. Where the system refuses, meshes differ a little from run to run.
void fix_addresses(char** argv) {
  const int now = personality(0xffffffff);
  if (now < 0 || (now & ADDR_NO_RANDOMIZE)) return;
  if (personality(now | ADDR_NO_RANDOMIZE) >= 0 && (personality(0xffffffff) & ADDR_NO_RANDOMIZE))
    execv("/proc/self/exe", argv);
}

int main(int argc, char** argv) {
  if (argc != 4) {
    fmt::print(stderr, "windhover-mesher GEOMETRY.toml MESH.msh FINER\n");
    return 2;
  }
  fix_addresses(argv);
  try {
    windhover::geometry::GeometryOptions geometry;
    windhover::io::read_options(windhover::io::read_toml(argv[1]), geometry);
    geometry.refine *= std::stod(argv[3]);
    const auto folder = std::filesystem::path(argv[1]).parent_path();
    complete(geometry.airframe, folder);
    for (auto& rotor : geometry.rotor) complete(rotor, folder);
    gmsh::initialize();
    gmsh::option::setNumber("General.Terminal", 1);
    gmsh::option::setNumber("Mesh.MshFileVersion", 4.1);
    windhover::mesher::mesh_aircraft(geometry);
    gmsh::write(argv[2]);
    gmsh::finalize();
    return 0;
  } catch (const windhover::UserError& error) {
    fmt::print("Error: {}\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    fmt::print("Error: {}\n", error.what());
    return 1;
  } catch (const std::string& error) {  // gmsh throws the text of its last message
    fmt::print("Error: {}\n", error);
    return 1;
  }
}
