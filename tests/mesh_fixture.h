// Meshes for tests, made by the gmsh program from tests/meshes/*.geo and kept in the build folder.
#pragma once
#include <fmt/format.h>
#include <petscsys.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>

namespace windhover {

/// The mesh file of tests/meshes/<name>.geo with the given numbers (DefineConstant in the .geo). Collective over comm.
inline std::string make_mesh(const std::string& name, const std::map<std::string, double>& numbers = {},
                             const std::string& options = "", MPI_Comm comm = PETSC_COMM_WORLD) {
  std::string label = name, arguments;
  for (const auto& [key, value] : numbers) {
    label += fmt::format("_{}_{}", key, value);
    arguments += fmt::format(" -setnumber {} {}", key, value);
  }
  for (const char c : options)
    if (c != ' ') label += c;
  const std::string folder = WINDHOVER_BINARY_DIR "/meshes", file = folder + "/" + label + ".msh";
  int rank = 0, failed = 0;
  MPI_Comm_rank(comm, &rank);
  if (rank == 0 && !std::filesystem::exists(file)) {
    std::filesystem::create_directories(folder);
    // written beside and renamed: tests on other numbers of ranks may make the same mesh at the same time
    const std::string part = fmt::format("{}/{}.{}.msh", folder, label, ::getpid());
    const std::string command = fmt::format("gmsh -3 -v 2 {} {} {}/tests/meshes/{}.geo -o '{}' > '{}.log' 2>&1 && mv '{}' '{}'",
                                            arguments, options, WINDHOVER_SOURCE_DIR, name, part, file, part, file);
    failed = std::system(command.c_str());
  }
  MPI_Bcast(&failed, 1, MPI_INT, 0, comm);
  if (failed != 0) throw std::runtime_error("gmsh could not make " + file + " (see the .log beside it)");
  return file;
}

}  // namespace windhover
