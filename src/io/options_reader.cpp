#include "io/options_reader.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace windhover::io {
namespace {

[[noreturn]] void refuse(const toml::node& node, const std::string& name, const std::string& expected) {
  throw UserError("{}: {} = {}: {}", place(node), name, value_text(node), expected);
}

double read_number(const toml::node& node, const std::string& name, const Key& key) {
  const auto value = node.value<double>();
  if (!node.is_number() || !value) refuse(node, name, "expected a number");
  if (!std::isfinite(*value)) refuse(node, name, "must be finite");
  if (!in_range(key, *value)) refuse(node, name, "must be " + range_text(key));
  return *value;
}

std::string read_string(const toml::node& node, const std::string& name, const Key& key) {
  const auto value = node.value_exact<std::string>();
  if (!value) {
    refuse(node, name, key.choices.empty() ? "expected a string" : "must be one of " + quoted_list(key.choices));
  }
  if (!key.choices.empty() && std::find(key.choices.begin(), key.choices.end(), *value) == key.choices.end()) {
    const std::string nearest = nearest_name(*value, key.choices);
    refuse(node, name,
           "must be one of " + quoted_list(key.choices) +
               (nearest.empty() ? "" : fmt::format(" (did you mean \"{}\"?)", nearest)));
  }
  return *value;
}

struct PlacedList {
  toml::source_position place;
  ValueList list;
};

void collect_lists(const toml::table& table, const std::string& path, std::vector<PlacedList>& lists) {
  for (const auto& [entry, node] : table) {
    const std::string name = path + std::string(entry.str());
    if (const toml::table* inner = node.as_table()) {
      collect_lists(*inner, name + ".", lists);
      continue;
    }
    const toml::array* array = node.as_array();
    if (!array || array->empty()) refuse(node, name, "expected a list of values");
    PlacedList& placed = lists.emplace_back(PlacedList{node.source().begin, {name, {}}});
    for (const toml::node& element : *array) placed.list.values.push_back(value_text(element));
  }
}

}  // namespace

std::string value_text(const toml::node& node) {
  if (const auto text = node.value_exact<std::string>()) return fmt::format("\"{}\"", *text);
  if (const auto number = node.value_exact<double>()) return fmt::format("{}", *number);
  std::ostringstream text;
  if (const toml::array* array = node.as_array()) {
    for (const toml::node& element : *array) text << (text.tellp() == 0 ? "[" : ", ") << value_text(element);
    text << (array->empty() ? "[]" : "]");
  } else {
    node.visit([&](const auto& concrete) { text << concrete; });
  }
  return text.str();
}

const toml::node* OptionsReader::find(const std::string& name) {
  known_.push_back(name);
  return table_.get(name);
}

const toml::table* OptionsReader::find_table(const std::string& name) {
  const toml::node* node = find(name);
  if (node && !node->is_table()) refuse(*node, prefix_ + name, "expected a table");
  return node ? node->as_table() : nullptr;
}

std::vector<const toml::table*> OptionsReader::find_tables(const std::string& name) {
  std::vector<const toml::table*> tables;
  const toml::node* node = find(name);
  if (!node) return tables;
  const toml::array* array = node->as_array();
  if (!array) refuse(*node, prefix_ + name, fmt::format("expected an array of tables: [[{}{}]]", prefix_, name));
  for (const toml::node& element : *array) {
    if (!element.is_table()) refuse(element, prefix_ + name, "expected a table");
    tables.push_back(element.as_table());
  }
  return tables;
}

void OptionsReader::key(const std::string& name, double& value, const Key& key) {
  if (const auto* node = find(name)) value = read_number(*node, prefix_ + name, key);
}

void OptionsReader::key(const std::string& name, int& value, const Key& key) {
  const auto* node = find(name);
  if (!node) return;
  const auto read = node->value_exact<int64_t>();
  if (!read || *read > std::numeric_limits<int>::max() || *read < std::numeric_limits<int>::min())
    refuse(*node, prefix_ + name, "expected an integer");
  value = static_cast<int>(read_number(*node, prefix_ + name, key));
}

void OptionsReader::key(const std::string& name, bool& value, const Key&) {
  const auto* node = find(name);
  if (!node) return;
  if (!node->is_boolean()) refuse(*node, prefix_ + name, "expected true or false");
  value = **node->as_boolean();
}

void OptionsReader::key(const std::string& name, std::string& value, const Key& key) {
  if (const auto* node = find(name)) value = read_string(*node, prefix_ + name, key);
}

void OptionsReader::key(const std::string& name, Eigen::Vector3d& value, const Key& key) {
  const auto* node = find(name);
  if (!node) return;
  const auto* array = node->as_array();
  if (!array || array->size() != 3) refuse(*node, prefix_ + name, "expected three numbers [x, y, z]");
  for (int i = 0; i < 3; ++i) value[i] = read_number((*array)[i], fmt::format("{}{}[{}]", prefix_, name, i), key);
}

void OptionsReader::key(const std::string& name, std::vector<std::string>& value, const Key& key) {
  const auto* node = find(name);
  if (!node) return;
  const auto* array = node->as_array();
  if (!array) refuse(*node, prefix_ + name, "expected a list of strings");
  value.clear();
  for (const toml::node& element : *array)
    value.push_back(read_string(element, fmt::format("{}{}[{}]", prefix_, name, value.size()), key));
}

void OptionsReader::key(const std::string& name, std::vector<double>& value, const Key& key) {
  const auto* node = find(name);
  if (!node) return;
  const auto* array = node->as_array();
  if (!array) refuse(*node, prefix_ + name, "expected a list of numbers");
  value.clear();
  for (const toml::node& element : *array)
    value.push_back(read_number(element, fmt::format("{}{}[{}]", prefix_, name, value.size()), key));
}

void OptionsReader::key(const std::string& name, std::vector<ValueList>& value, const Key&) {
  const toml::table* table = find_table(name);
  if (!table) return;
  std::vector<PlacedList> lists;
  collect_lists(*table, "", lists);
  std::sort(lists.begin(), lists.end(), [](const PlacedList& a, const PlacedList& b) { return a.place < b.place; });
  value.clear();
  for (PlacedList& placed : lists) value.push_back(std::move(placed.list));
}

void OptionsReader::key(const std::string& name, std::map<std::string, double>& value, const Key& key) {
  const toml::table* table = find_table(name);
  if (!table) return;
  value.clear();
  for (const auto& [entry, node] : *table)
    value[std::string(entry.str())] = read_number(node, fmt::format("{}{}.{}", prefix_, name, entry.str()), key);
}

void OptionsReader::key(const std::string& name, std::map<std::string, std::string>& value, const Key& key) {
  const toml::table* table = find_table(name);
  if (!table) return;
  value.clear();
  for (const auto& [entry, node] : *table)
    value[std::string(entry.str())] = read_string(node, fmt::format("{}{}.{}", prefix_, name, entry.str()), key);
}

void OptionsReader::reject_unknown() const {
  for (const auto& [name, node] : table_) {
    const std::string text(name.str());
    if (std::find(known_.begin(), known_.end(), text) != known_.end()) continue;
    const bool section = prefix_.empty() || node.is_table();
    throw UserError("{}: {}{}: unknown {}{}{}", place(node), prefix_, text, section ? "section" : "key", condition_,
                    suggestion(text, known_));
  }
}

}  // namespace windhover::io
