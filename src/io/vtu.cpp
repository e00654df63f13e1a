#include "io/vtu.h"

#include <fmt/format.h>

#include <bit>

#include "io/file.h"

namespace windhover::io {
namespace {

static_assert(std::endian::native == std::endian::little, "the header says so");

/// The file's appended section: each array is its length in bytes followed by its values.
struct Appended {
  struct Part {
    const void* data;
    std::uint64_t bytes;
  };
  std::vector<Part> parts;
  std::uint64_t offset = 0;

  /// The element that describes an array.
  template <class T>
  std::string add(const char* type, const std::string& name, int components, const std::vector<T>& values) {
    const std::uint64_t bytes = values.size() * sizeof(T);
    const std::string element = fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n", type,
        xml_text(name), components, offset);
    parts.push_back({values.data(), bytes});
    offset += sizeof(bytes) + bytes;
    return element;
  }
};

}  // namespace

std::string xml_text(const std::string& text) {
  std::string safe;
  for (char c : text) {
    switch (c) {
      case '&': safe += "&amp;"; break;
      case '<': safe += "&lt;"; break;
      case '>': safe += "&gt;"; break;
      case '"': safe += "&quot;"; break;
      default: safe += c;
    }
  }
  return safe;
}

void write_vtu(const std::filesystem::path& path, const FieldBlock& block) {
  Appended data;
  std::string xml = fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
      "<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
      block.points.size() / 3, block.types.size());
  xml += "<Points>\n" + data.add("Float64", "Points", 3, block.points) + "</Points>\n<Cells>\n";
  xml += data.add("Int64", "connectivity", 1, block.connectivity);
  xml += data.add("Int64", "offsets", 1, block.offsets);
  xml += data.add("UInt8", "types", 1, block.types) + "</Cells>\n<CellData>\n";
  for (const auto& array : block.arrays) xml += data.add("Float32", array.name, array.components, array.values);
  xml += "</CellData>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";

  OutputFile file(path, OutputFile::Mode::create);
  file.write(xml);
  for (const auto& part : data.parts) {
    file.write(&part.bytes, sizeof(part.bytes));
    file.write(part.data, part.bytes);
  }
  file.write("\n</AppendedData>\n</VTKFile>\n");
  file.close();
}

}  // namespace windhover::io
