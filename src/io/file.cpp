#include "io/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <utility>

#include "base/errors.h"

namespace windhover::io {

namespace fs = std::filesystem;

OutputFile::OutputFile(fs::path path, Mode mode) : path_(std::move(path)) {
  descriptor_ = open(path_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | (mode == Mode::create ? O_TRUNC : O_APPEND), 0666);
  check(descriptor_ >= 0, "open");
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void OutputFile::write(const void* data, size_t bytes) {
  const char* from = static_cast<const char*>(data);
  while (bytes > 0) {
    const ssize_t written = ::write(descriptor_, from, bytes);
    if (written < 0 && errno == EINTR) continue;
    check(written > 0, "write");
    from += written;
    bytes -= static_cast<size_t>(written);
  }
}

void OutputFile::write_whole(std::string_view text) {
  struct stat status = {};
  check(fstat(descriptor_, &status) == 0, "write");
  try {
    write(text);
  } catch (const UserError&) {
    if (S_ISREG(status.st_mode)) check(ftruncate(descriptor_, status.st_size) == 0, "write");
    throw;
  }
}

void OutputFile::reserve(std::uint64_t bytes) {
  errno = posix_fallocate(descriptor_, 0, static_cast<off_t>(bytes));
  check(errno == 0, "write");
}

void OutputFile::sync() { check(fsync(descriptor_) == 0, "write"); }

void OutputFile::close() { check(::close(std::exchange(descriptor_, -1)) == 0, "write"); }

void OutputFile::check(bool success, const char* action) const {
  if (!success) throw UserError("{}: cannot {} this file: {}", path_.string(), action, std::strerror(errno));
}

void publish(const fs::path& temporary, const fs::path& path) {
  OutputFile file(temporary, OutputFile::Mode::append);
  file.sync();
  file.close();
  std::error_code error;
  fs::rename(temporary, path, error);
  if (error) throw UserError("{}: cannot write this file: {}", path.string(), error.message());
  // The new name is on the disk only when its folder is.
  const int folder = open(path.parent_path().empty() ? "." : path.parent_path().c_str(), O_RDONLY | O_CLOEXEC);
  if (folder >= 0) {
    fsync(folder);
    ::close(folder);
  }
}

void write_atomically(const fs::path& path, std::string_view text) {
  const fs::path temporary = path.string() + ".tmp";
  try {
    OutputFile file(temporary, OutputFile::Mode::create);
    file.write(text);
    file.close();
    publish(temporary, path);
  } catch (const UserError&) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    throw;
  }
}

std::string read_text(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  if (!fs::is_regular_file(path) || !stream) throw UserError("{}: cannot read this file", path.string());
  text << stream.rdbuf();
  return text.str();
}

void make_folder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw UserError("{}: cannot make this folder: {}", path.string(), error.message());
}

}  // namespace windhover::io
