// Reads declared options (base/options.h) from a TOML case file, with overrides from the command line.
#pragma once
#include <toml++/toml.h>
#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/errors.h"
#include "base/options.h"

namespace windhover::io {

/// "file:line" of a node, or the override it came from.
std::string place(const toml::node& node);

/// A value as TOML text, numbers as short as they read back exactly.
std::string value_text(const toml::node& node);

/// Parses a TOML file. Each override is `dotted.key=value`, the value parsed as TOML and a bare word taken as a
/// string; an element of an array of tables is named by its number from 0.
toml::table read_toml(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

/// `from` over `target`: tables are united, in arrays of tables by number; anything else is replaced. UserError: no such element.
void merge(toml::table& target, toml::table& from);

/// "file:line" of a dotted key, or the file when the key is not there.
std::string place(const toml::table& root, const std::string& dotted_key);

/// The visitor that fills the declared values from one table.
class OptionsReader {
 public:
  explicit OptionsReader(const toml::table& table, std::string prefix = "")
      : table_(table), prefix_(std::move(prefix)) {}

  void key(const std::string& name, double& value, const Key& key);
  void key(const std::string& name, int& value, const Key& key);
  void key(const std::string& name, bool& value, const Key& key);
  void key(const std::string& name, std::string& value, const Key& key);
  void key(const std::string& name, Eigen::Vector3d& value, const Key& key);
  void key(const std::string& name, std::vector<std::string>& value, const Key& key);
  void key(const std::string& name, std::vector<double>& value, const Key& key);
  /// A table of lists of any values, its keys dotted and in the order of the file.
  void key(const std::string& name, std::vector<ValueList>& value, const Key& key);
  void key(const std::string& name, std::map<std::string, double>& value, const Key& key);
  void key(const std::string& name, std::map<std::string, std::string>& value, const Key& key);

  template <class T>
  void key(const std::string& name, std::optional<T>& value, const Key& declared) {
    if (!table_.contains(name)) {
      known_.push_back(name);
      return;
    }
    key(name, value.emplace(), declared);
  }

  template <class Options>
  void section(const std::string& name, Options& options, const std::string&) {
    if (const toml::table* table = find_table(name)) read(*table, prefix_ + name, options);
  }

  template <class Options>
  void tables(const std::string& name, std::vector<Options>& list, const std::string&) {
    list.clear();
    for (const toml::table* table : find_tables(name)) {
      const std::string path = fmt::format("{}{}[{}]", prefix_, name, list.size());
      read(*table, path, list.emplace_back());
    }
  }

  template <class Body>
  void when(const std::string& name, const std::string& value, const std::string& wanted, Body&& body,
            bool may_be_unused = false) {
    condition_ = fmt::format(" for {} = \"{}\"", name, value);
    if (value == wanted || (may_be_unused && table_.contains(name))) body();
  }

  /// UserError for the first key that was not declared; call after declare().
  void reject_unknown() const;

 private:
  template <class Options>
  void read(const toml::table& table, const std::string& path, Options& options) {
    OptionsReader reader(table, path + ".");
    declare(reader, options);
    reader.reject_unknown();
  }
  const toml::node* find(const std::string& name);
  const toml::table* find_table(const std::string& name);
  std::vector<const toml::table*> find_tables(const std::string& name);

  const toml::table& table_;
  std::string prefix_;
  std::string condition_;
  std::vector<std::string> known_;
};

/// Fills the options of a whole file.
template <class Options>
void read_options(const toml::table& root, Options& options) {
  OptionsReader reader(root);
  declare(reader, options);
  reader.reject_unknown();
}

}  // namespace windhover::io
