// The folder of a run's results.
#pragma once
#include <mpi.h>

#include <Eigen/Core>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace windhover::io {

/// Makes the folder. UserError when it holds another run that this one does not continue. Collective.
void prepare_results(const std::filesystem::path& directory, bool restart, MPI_Comm comm);

/// A small file, written in one step by rank 0. Collective.
void write_text(const std::filesystem::path& file, const std::string& text, MPI_Comm comm);

/// A vector as a JSON list.
inline std::vector<double> list(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

/// summary.json and the like, in the same way.
void write_json(const std::filesystem::path& file, const nlohmann::ordered_json& json, MPI_Comm comm);

}  // namespace windhover::io
