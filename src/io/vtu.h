// One block's cells on one rank as a VTK XML unstructured grid with appended raw data.
#pragma once
#include <filesystem>
#include <string>

#include "io/fields.h"

namespace windhover::io {

void write_vtu(const std::filesystem::path& path, const FieldBlock& block);

/// Text as it may stand in an XML attribute.
std::string xml_text(const std::string& text);

}  // namespace windhover::io
