// Files that are whole or not there: every write is checked, and a replaced file changes in one step.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace windhover::io {

/// A file open for writing; UserError naming the file when anything fails, such as a full disk.
class OutputFile {
 public:
  enum class Mode { create, append };
  OutputFile(std::filesystem::path path, Mode mode);
  OutputFile(OutputFile&& other) noexcept;
  ~OutputFile();

  void write(const void* data, size_t bytes);
  void write(std::string_view text) { write(text.data(), text.size()); }
  /// As write, but nothing remains of a text that could not be written whole.
  void write_whole(std::string_view text);
  /// Makes sure that the file can grow to that size.
  void reserve(std::uint64_t bytes);
  void sync();
  void close();

 private:
  void check(bool success, const char* action) const;

  std::filesystem::path path_;
  int descriptor_ = -1;
};

/// Writes to a temporary name, syncs, and renames. Readers see the old content or the new, never a part.
void write_atomically(const std::filesystem::path& path, std::string_view text);

/// The second half of that: syncs a file written under a temporary name and renames it.
void publish(const std::filesystem::path& temporary, const std::filesystem::path& path);

std::string read_text(const std::filesystem::path& path);

void make_folder(const std::filesystem::path& path);

}  // namespace windhover::io
