// Parsing of TOML files and of overrides given on the command line.
#include <algorithm>
#include <charconv>
#include <fstream>
#include <sstream>

#include "io/options_reader.h"

namespace windhover::io {
namespace {

const std::string override_mark = "--set ";

/// An element of an array is named by its number.
void merge_element(toml::array& target, const std::string& name, toml::node& from, const std::string& key) {
  size_t index = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), index);
  if (error != std::errc() || end != name.data() + name.size() || index >= target.size())
    throw UserError("{}: {} has elements 0 to {}, not \"{}\"", place(from), key, int(target.size()) - 1, name);
  if (auto* element = target[index].as_table(); element && from.is_table()) return merge(*element, *from.as_table());
  from.visit([&](auto& value) { target.replace(target.cbegin() + index, std::move(value)); });
}

toml::table parse_override(const std::string& text) {
  const std::string source = override_mark + text;
  const size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) throw UserError("{}: expected key=value", source);
  const std::string value = text.substr(equals + 1);
  std::string key = text.substr(0, equals);
  std::replace(key.begin(), key.end(), '[', '.');  // motion[0].axis is motion.0.axis
  std::erase(key, ']');
  try {
    return toml::parse(key + " = " + value, source);
  } catch (const toml::parse_error&) {
  }
  try {
    std::ostringstream quoted;
    quoted << toml::value<std::string>(value);
    return toml::parse(key + " = " + quoted.str(), source);
  } catch (const toml::parse_error&) {
    throw UserError("{}: expected key=value with a dotted key such as time.steps", source);
  }
}

}  // namespace

void merge(toml::table& target, toml::table& from) {
  for (auto&& [key, node] : from) {
    toml::node* there = target.get(key);
    const bool on_the_way = node.is_table() && !node.as_table()->is_inline();  // a part of the dotted key
    if (there && there->is_table() && on_the_way) {
      merge(*there->as_table(), *node.as_table());
    } else if (there && there->is_array() && on_the_way) {
      for (auto&& [name, element] : *node.as_table())
        merge_element(*there->as_array(), std::string(name.str()), element, std::string(key.str()));
    } else {
      // Moved, not copied: a copied node forgets where it came from.
      node.visit([&, &k = key](auto& value) { target.insert_or_assign(k, std::move(value)); });
    }
  }
}

std::string place(const toml::node& node) {
  const toml::source_region& source = node.source();
  const std::string path = source.path ? *source.path : "";
  if (path.starts_with(override_mark) || source.begin.line == 0) return path;
  return fmt::format("{}:{}", path, source.begin.line);
}

std::string place(const toml::table& root, const std::string& dotted_key) {
  const auto node = root.at_path(dotted_key);
  if (node) return place(*node.node());
  return root.source().path ? *root.source().path : "";
}

toml::table read_toml(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  std::ifstream stream(file);
  std::ostringstream text;
  if (!std::filesystem::is_regular_file(file) || !(text << stream.rdbuf()))
    throw UserError("{}: cannot read this file", file.string());
  toml::table root;
  try {
    root = toml::parse(text.str(), file.string());
  } catch (const toml::parse_error& error) {
    throw UserError("{}:{}: not valid TOML: {}", file.string(), error.source().begin.line, error.description());
  }
  for (const auto& text : overrides) {
    toml::table one = parse_override(text);
    merge(root, one);
  }
  return root;
}

}  // namespace windhover::io
