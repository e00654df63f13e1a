// Writes declared options (base/options.h) as TOML, every default included: the effective case.
#pragma once
#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/options.h"

namespace windhover::io {

class OptionsWriter {
 public:
  explicit OptionsWriter(std::string path = "") : path_(std::move(path)) {}

  void key(const std::string& name, double value, const Key&);
  void key(const std::string& name, int value, const Key&);
  void key(const std::string& name, bool value, const Key&);
  void key(const std::string& name, const std::string& value, const Key&);
  void key(const std::string& name, const Eigen::Vector3d& value, const Key&);
  void key(const std::string& name, const std::vector<std::string>& value, const Key&);
  void key(const std::string& name, const std::vector<double>& value, const Key&);
  void key(const std::string& name, const std::map<std::string, double>& value, const Key&);
  void key(const std::string& name, const std::map<std::string, std::string>& value, const Key&);

  template <class T>
  void key(const std::string& name, const std::optional<T>& value, const Key& declared) {
    if (value) key(name, *value, declared);
  }

  template <class Options>
  void section(const std::string& name, Options& options, const std::string&) {
    OptionsWriter writer(below(name));
    declare(writer, options);
    sections_ += "\n[" + writer.path_ + "]\n" + writer.text();
  }

  template <class Options>
  void tables(const std::string& name, std::vector<Options>& list, const std::string&) {
    for (Options& options : list) {
      OptionsWriter writer(below(name));
      declare(writer, options);
      sections_ += "\n[[" + writer.path_ + "]]\n" + writer.text();
    }
  }

  template <class Body>
  void when(const std::string&, const std::string& value, const std::string& wanted, Body&& body,
            bool = false) {
    if (value == wanted) body();
  }

  std::string text() const { return keys_ + sections_; }

 private:
  std::string below(const std::string& name) const { return path_.empty() ? name : path_ + "." + name; }

  std::string path_;
  std::string keys_, sections_;  // in TOML a table's own keys come before its sub-tables
};

template <class Options>
std::string options_text(Options options) {
  OptionsWriter writer;
  declare(writer, options);
  return writer.text();
}

}  // namespace windhover::io
