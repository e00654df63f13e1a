#include "io/csv.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <sstream>

#include "base/collective.h"
#include "base/errors.h"
#include "base/options.h"

namespace windhover::io {

CsvTable::CsvTable(std::filesystem::path path, std::vector<std::string> columns, MPI_Comm comm,
                   std::optional<std::int64_t> last_step)
    : path_(std::move(path)), columns_(columns.size()), comm_(comm) {
  on_root(comm_, [&] {
    const std::string header = fmt::format("{}\n", fmt::join(columns, ","));
    if (last_step) {
      cut_back(header, *last_step);
    } else {
      write_atomically(path_, header);
    }
    file_.emplace(path_, OutputFile::Mode::append);
  });
}

void CsvTable::cut_back(const std::string& header, std::int64_t last_step) const {
  const std::string text = read_text(path_);
  if (!text.starts_with(header)) throw UserError("{}: has other columns than this program writes", path_.string());
  std::string kept = header;
  size_t begin = header.size();
  // A last row without its line end was cut short: it is dropped as well.
  for (size_t end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
    if (std::strtoll(text.c_str() + begin, nullptr, 10) <= last_step) kept.append(text, begin, end + 1 - begin);
  }
  write_atomically(path_, kept);
}

void CsvTable::append(std::span<const double> row) {
  assert(row.size() == columns_);
  on_root(comm_, [&] { file_->write_whole(fmt::format("{}\n", fmt::join(row, ","))); });
}

CsvColumns::CsvColumns(std::filesystem::path path) : path_(std::move(path)) {
  std::istringstream text(read_text(path_));
  std::string line, cell;
  std::getline(text, line);
  for (std::istringstream header(line); std::getline(header, cell, ',');) names_.push_back(cell);
  columns_.resize(names_.size());
  while (std::getline(text, line) && !text.eof()) {  // whole rows end with a line end
    std::istringstream row(line);
    for (auto& column : columns_) {
      std::getline(row, cell, ',');
      column.push_back(std::strtod(cell.c_str(), nullptr));
    }
  }
}

const std::vector<double>& CsvColumns::operator[](const std::string& column) const {
  const auto there = std::find(names_.begin(), names_.end(), column);
  if (there == names_.end()) throw UserError("{}: has no column \"{}\"{}", path_.string(), column, suggestion(column, names_));
  return columns_[there - names_.begin()];
}

}  // namespace windhover::io
