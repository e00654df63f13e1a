#include "io/checkpoint_files.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/checkpoint.h"

namespace windhover::io {

namespace fs = std::filesystem;

fs::path checkpoint_folder(const fs::path& directory) { return directory / "checkpoint"; }

fs::path checkpoint_name(long long step) { return fmt::format("step_{:08}.h5", step); }

std::vector<fs::path> checkpoints_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename();
    if (name.starts_with("step_") && name.ends_with(".h5")) files.push_back(entry.path());
  }
  // Longer names are later steps: numbers above 8 digits are not padded.
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    const std::string left = a.filename(), right = b.filename();
    return std::pair(left.size(), left) > std::pair(right.size(), right);
  });
  return files;
}

std::optional<fs::path> newest_checkpoint(const fs::path& directory) {
  const auto files = checkpoints_in(checkpoint_folder(directory));
  return files.empty() ? std::nullopt : std::optional(files.front());
}

}  // namespace windhover::io
