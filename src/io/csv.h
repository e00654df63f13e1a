// Tables of numbers that grow by a row at a time and can be cut back for a restart.
#pragma once
#include <mpi.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/file.h"

namespace windhover::io {

/// A CSV file that rank 0 writes; each row is in the file when append() returns. Collective: all ranks give the same
/// rows and see the same errors (UserError, such as a full disk; the file then ends with the last whole row).
class CsvTable {
 public:
  /// A new file or, with `last_step`, the file there without the rows whose first column is greater.
  CsvTable(std::filesystem::path path, std::vector<std::string> columns, MPI_Comm comm,
           std::optional<std::int64_t> last_step = {});

  /// Numbers are written so that they read back exactly; whole numbers as integers.
  void append(std::span<const double> row);

 private:
  void cut_back(const std::string& header, std::int64_t last_step) const;

  std::filesystem::path path_;
  size_t columns_;
  MPI_Comm comm_;
  std::optional<OutputFile> file_;  // on rank 0
};

/// A CSV file with a header, read by column. UserError: no such file or column; a last row that was cut short is left out.
class CsvColumns {
 public:
  explicit CsvColumns(std::filesystem::path path);
  const std::vector<double>& operator[](const std::string& column) const;

 private:
  std::filesystem::path path_;
  std::vector<std::string> names_;
  std::vector<std::vector<double>> columns_;
};

}  // namespace windhover::io
