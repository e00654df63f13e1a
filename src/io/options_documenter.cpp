#include "io/options_documenter.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace windhover::io {
namespace {

std::string quoted_or_dash(const std::string& text) { return text.empty() ? "–" : fmt::format("\"{}\"", text); }

}  // namespace

void OptionsDocumenter::row(const std::string& name, const std::string& type, const std::string& value,
                            const Key& key) {
  const std::string allowed = key.choices.empty() ? range_text(key) : quoted_list(key.choices);
  rows_ += fmt::format("| `{}` | {} | {} | {} | {}{} |\n", name, type, value, allowed, condition_, key.doc);
}

std::string OptionsDocumenter::text() const {
  if (rows_.empty()) return sections_;
  return "\n| key | type | default | allowed | meaning |\n|---|---|---|---|---|\n" + rows_ + sections_;
}

void OptionsDocumenter::key(const std::string& name, double value, const Key& key) {
  row(name, "number", fmt::format("{}", value), key);
}
void OptionsDocumenter::key(const std::string& name, int value, const Key& key) {
  row(name, "integer", fmt::format("{}", value), key);
}
void OptionsDocumenter::key(const std::string& name, bool value, const Key& key) {
  row(name, "true/false", fmt::format("{}", value), key);
}
void OptionsDocumenter::key(const std::string& name, const std::string& value, const Key& key) {
  row(name, "string", quoted_or_dash(value), key);
}
void OptionsDocumenter::key(const std::string& name, const Eigen::Vector3d& value, const Key& key) {
  row(name, "three numbers", fmt::format("[{}, {}, {}]", value[0], value[1], value[2]), key);
}
void OptionsDocumenter::key(const std::string& name, const std::vector<std::string>& value, const Key& key) {
  row(name, "list of strings", fmt::format("[{}]", quoted_list(value)), key);
}
void OptionsDocumenter::key(const std::string& name, const std::vector<double>& value, const Key& key) {
  row(name, "list of numbers", fmt::format("[{}]", fmt::join(value, ", ")), key);
}
void OptionsDocumenter::key(const std::string& name, const std::vector<ValueList>&, const Key& key) {
  row(name, "table of lists", "{}", key);
}
void OptionsDocumenter::key(const std::string& name, const std::map<std::string, double>&, const Key& key) {
  row(name, "table of numbers", "{}", key);
}
void OptionsDocumenter::key(const std::string& name, const std::map<std::string, std::string>&, const Key& key) {
  row(name, "table of strings", "{}", key);
}
void OptionsDocumenter::key(const std::string& name, const std::optional<double>&, const Key& key) {
  row(name, "number", "–", key);
}
void OptionsDocumenter::key(const std::string& name, const std::optional<int>&, const Key& key) {
  row(name, "integer", "–", key);
}
void OptionsDocumenter::key(const std::string& name, const std::optional<Eigen::Vector3d>&, const Key& key) {
  row(name, "three numbers", "–", key);
}

}  // namespace windhover::io
