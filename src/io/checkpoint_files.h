// Names of checkpoint files, and what their writer and their reader share.
#pragma once
#include <filesystem>
#include <vector>

namespace windhover::io {

/// Marks our files and their layout.
inline constexpr const char* format_attribute = "windhover_checkpoint_format";
inline constexpr long long checkpoint_format = 1;

std::filesystem::path checkpoint_folder(const std::filesystem::path& directory);
std::filesystem::path checkpoint_name(long long step);

/// The checkpoints in a folder, the latest step first.
std::vector<std::filesystem::path> checkpoints_in(const std::filesystem::path& folder);

}  // namespace windhover::io
