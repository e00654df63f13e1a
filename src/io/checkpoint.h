// Checkpoints: HDF5 files of named attributes and named tables of numbers, DIR/checkpoint/step_00001234.h5.
#pragma once
#include <hdf5.h>
#include <mpi.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace windhover::io {

using Attribute = std::variant<double, std::int64_t, std::uint64_t, std::string, std::vector<double>>;

/// Owner of an HDF5 object.
class HdfHandle {
 public:
  HdfHandle() = default;
  HdfHandle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  HdfHandle(HdfHandle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  HdfHandle& operator=(HdfHandle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~HdfHandle() { close(); }
  operator hid_t() const { return id_; }
  bool close() { return id_ < 0 || close_(std::exchange(id_, -1)) >= 0; }

 private:
  hid_t id_ = -1;
  herr_t (*close_)(hid_t) = nullptr;
};

/// Writes one checkpoint under a temporary name; finish() gives it its name and keeps the two newest. Before that, or
/// after an error (UserError, such as a full disk), the temporary file is removed and older checkpoints stay whole.
/// Every member is collective, and errors are the same on every rank.
class CheckpointWriter {
 public:
  CheckpointWriter(const std::filesystem::path& directory, std::int64_t step, MPI_Comm comm);
  ~CheckpointWriter();
  CheckpointWriter(const CheckpointWriter&) = delete;
  CheckpointWriter& operator=(const CheckpointWriter&) = delete;

  /// The same value on every rank.
  void attribute(const std::string& name, const Attribute& value);

  /// A table of doubles, row after row: the ranks' rows one after the other.
  void array(const std::string& name, std::span<const double> rows, int columns);

  void finish();

 private:
  void check(bool success) const;
  void reserve(std::uint64_t bytes) const;
  void remove_temporary() const;

  std::filesystem::path folder_, path_, temporary_;
  MPI_Comm comm_;
  HdfHandle file_;
  std::uint64_t bytes_ = 256 * 1024;  ///< at most that many so far; attributes have this room
};

/// Reads one checkpoint. UserError naming the file when it is cut short, is no checkpoint, or lacks what is asked for.
/// Every member is collective.
class CheckpointReader {
 public:
  CheckpointReader(std::filesystem::path path, MPI_Comm comm);

  /// T: one of the alternatives of Attribute.
  template <class T>
  T attribute(const std::string& name) const;

  bool has_array(const std::string& name) const;
  std::int64_t rows(const std::string& name) const;

  /// Rows [first, first + count) of a table with that many columns; each rank reads its own range.
  std::vector<double> array(const std::string& name, int columns, std::int64_t first, std::int64_t count) const;

 private:
  void check(bool success, const std::string& problem) const;

  std::filesystem::path path_;
  MPI_Comm comm_;
  HdfHandle file_;
};

/// The checkpoint of the latest step in DIR/checkpoint.
std::optional<std::filesystem::path> newest_checkpoint(const std::filesystem::path& directory);

}  // namespace windhover::io
