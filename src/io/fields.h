// Fields for ParaView: DIR/fields/fields.pvd names one multi-block data set per output, with its time.
#pragma once
#include <mpi.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace windhover::io {

/// Values of a block's cells, `components` (1 or 3) per cell.
struct FieldArray {
  std::string name;
  int components = 1;
  std::vector<float> values;
};

/// This rank's part of a named set of cells: all ranks give the same blocks in the same order, with the same arrays.
struct FieldBlock {
  std::string name;
  std::vector<double> points;              ///< x, y, z of each point
  std::vector<std::int64_t> connectivity;  ///< points of each cell, in VTK's order
  std::vector<std::int64_t> offsets;       ///< end of each cell in connectivity
  std::vector<std::uint8_t> types;         ///< VTK's number of each cell's type
  std::vector<FieldArray> arrays;
};

/// Writes the outputs of a run: step_N.vtm with one .vtu per block and rank, then fields.pvd in one step, so that
/// ParaView never sees a part of an output. Collective; UserError when a file cannot be written.
class FieldWriter {
 public:
  /// With `last_step`: continues the outputs there, after removing those of later steps.
  FieldWriter(const std::filesystem::path& directory, MPI_Comm comm, std::optional<std::int64_t> last_step = {});

  void write(std::int64_t step, double time_s, const std::vector<FieldBlock>& blocks);

 private:
  void read_outputs(std::int64_t last_step);
  void write_index(std::int64_t step, const std::vector<FieldBlock>& blocks, const std::vector<int>& cells) const;
  void write_collection() const;

  std::filesystem::path folder_;
  MPI_Comm comm_;
  std::map<std::int64_t, std::string> times_;  // of the outputs, as text, by step; on rank 0
};

}  // namespace windhover::io
