#include "io/fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <sstream>

#include "base/collective.h"
#include "io/file.h"
#include "io/vtu.h"

namespace windhover::io {
namespace {

namespace fs = std::filesystem;

std::string step_name(std::int64_t step) { return fmt::format("step_{:08}", step); }

/// A file name that any system takes; the number keeps names apart that differ in other characters only.
std::string piece_name(size_t block, const std::string& name, int rank) {
  std::string safe = name;
  std::replace_if(
      safe.begin(), safe.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
  return fmt::format("{}_{}_{:04}.vtu", block, safe, rank);
}

}  // namespace

FieldWriter::FieldWriter(const fs::path& directory, MPI_Comm comm, std::optional<std::int64_t> last_step)
    : folder_(directory / "fields"), comm_(comm) {
  on_root(comm_, [&] {
    make_folder(folder_);
    if (last_step && fs::exists(folder_ / "fields.pvd")) read_outputs(*last_step);
    write_collection();
  });
}

void FieldWriter::read_outputs(std::int64_t last_step) {
  std::istringstream text(read_text(folder_ / "fields.pvd"));
  const std::regex entry("timestep=\"([^\"]*)\" file=\"step_([0-9]+).vtm\"");
  std::smatch found;
  std::error_code ignored;
  for (std::string line; std::getline(text, line);) {
    if (!std::regex_search(line, found, entry)) continue;
    const std::int64_t step = std::stoll(found[2]);
    if (step <= last_step) {
      times_[step] = found[1];
    } else {
      fs::remove(folder_ / (step_name(step) + ".vtm"), ignored);
      fs::remove_all(folder_ / step_name(step), ignored);
    }
  }
}

void FieldWriter::write(std::int64_t step, double time_s, const std::vector<FieldBlock>& blocks) {
  const fs::path pieces = folder_ / step_name(step);
  on_root(comm_, [&] { make_folder(pieces); });
  std::vector<int> cells(blocks.size()), cells_of_ranks(blocks.size() * size_of(comm_));
  collectively(comm_, [&] {
    for (size_t i = 0; i < blocks.size(); ++i) {
      cells[i] = static_cast<int>(blocks[i].types.size());
      if (cells[i] > 0) write_vtu(pieces / piece_name(i, blocks[i].name, rank_of(comm_)), blocks[i]);
    }
  });
  const int count = static_cast<int>(cells.size());
  MPI_Gather(cells.data(), count, MPI_INT, cells_of_ranks.data(), count, MPI_INT, 0, comm_);
  on_root(comm_, [&] {
    write_index(step, blocks, cells_of_ranks);
    times_[step] = fmt::format("{}", time_s);
    write_collection();
  });
}

void FieldWriter::write_index(std::int64_t step, const std::vector<FieldBlock>& blocks,
                              const std::vector<int>& cells) const {
  std::string xml =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\">\n<vtkMultiBlockDataSet>\n";
  for (size_t i = 0; i < blocks.size(); ++i) {
    xml += fmt::format("<Piece index=\"{}\" name=\"{}\">\n", i, xml_text(blocks[i].name));
    for (int rank = 0, piece = 0; rank < size_of(comm_); ++rank) {
      if (cells[rank * blocks.size() + i] == 0) continue;
      xml += fmt::format("<DataSet index=\"{}\" file=\"{}/{}\"/>\n", piece++, step_name(step),
                         piece_name(i, blocks[i].name, rank));
    }
    xml += "</Piece>\n";
  }
  xml += "</vtkMultiBlockDataSet>\n</VTKFile>\n";
  write_atomically(folder_ / (step_name(step) + ".vtm"), xml);
}

void FieldWriter::write_collection() const {
  std::string xml = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n";
  for (const auto& [step, time] : times_)
    xml += fmt::format("<DataSet timestep=\"{}\" file=\"{}.vtm\"/>\n", time, step_name(step));
  xml += "</Collection>\n</VTKFile>\n";
  write_atomically(folder_ / "fields.pvd", xml);
}

}  // namespace windhover::io
