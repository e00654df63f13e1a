#include "io/options_writer.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <sstream>

namespace windhover::io {
namespace {

std::string quoted(const std::string& text) {
  std::ostringstream stream;
  stream << toml::value<std::string>(text);
  return stream.str();
}

/// A key as it is when TOML allows that, otherwise quoted.
std::string key_text(const std::string& name) {
  const bool bare = !name.empty() && name.find_first_not_of(
                                         "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                         "0123456789_-") == std::string::npos;
  return bare ? name : quoted(name);
}

}  // namespace

void OptionsWriter::key(const std::string& name, double value, const Key&) {
  keys_ += fmt::format("{} = {}\n", name, value);
}

void OptionsWriter::key(const std::string& name, int value, const Key&) {
  keys_ += fmt::format("{} = {}\n", name, value);
}

void OptionsWriter::key(const std::string& name, bool value, const Key&) {
  keys_ += fmt::format("{} = {}\n", name, value);
}

void OptionsWriter::key(const std::string& name, const std::string& value, const Key&) {
  keys_ += fmt::format("{} = {}\n", name, quoted(value));
}

void OptionsWriter::key(const std::string& name, const Eigen::Vector3d& value, const Key&) {
  keys_ += fmt::format("{} = [{}, {}, {}]\n", name, value[0], value[1], value[2]);
}

void OptionsWriter::key(const std::string& name, const std::vector<std::string>& value, const Key&) {
  std::string list;
  for (const auto& text : value) list += (list.empty() ? "" : ", ") + quoted(text);
  keys_ += fmt::format("{} = [{}]\n", name, list);
}

void OptionsWriter::key(const std::string& name, const std::vector<double>& value, const Key&) {
  keys_ += fmt::format("{} = [{}]\n", name, fmt::join(value, ", "));
}

void OptionsWriter::key(const std::string& name, const std::map<std::string, double>& value, const Key&) {
  sections_ += fmt::format("\n[{}.{}]\n", path_, name);
  for (const auto& [entry, number] : value) sections_ += fmt::format("{} = {}\n", key_text(entry), number);
}

void OptionsWriter::key(const std::string& name, const std::map<std::string, std::string>& value, const Key&) {
  sections_ += fmt::format("\n[{}.{}]\n", path_, name);
  for (const auto& [entry, text] : value) sections_ += fmt::format("{} = {}\n", key_text(entry), quoted(text));
}

}  // namespace windhover::io
