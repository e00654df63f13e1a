// Documents declared options (base/options.h) as Markdown: one table per section.
#pragma once
#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/options.h"

namespace windhover::io {

class OptionsDocumenter {
 public:
  explicit OptionsDocumenter(std::string path = "") : path_(std::move(path)) {}

  void key(const std::string& name, double value, const Key& key);
  void key(const std::string& name, int value, const Key& key);
  void key(const std::string& name, bool value, const Key& key);
  void key(const std::string& name, const std::string& value, const Key& key);
  void key(const std::string& name, const Eigen::Vector3d& value, const Key& key);
  void key(const std::string& name, const std::vector<std::string>& value, const Key& key);
  void key(const std::string& name, const std::vector<double>& value, const Key& key);
  void key(const std::string& name, const std::vector<ValueList>& value, const Key& key);
  void key(const std::string& name, const std::map<std::string, double>& value, const Key& key);
  void key(const std::string& name, const std::map<std::string, std::string>& value, const Key& key);
  void key(const std::string& name, const std::optional<double>& value, const Key& key);
  void key(const std::string& name, const std::optional<int>& value, const Key& key);
  void key(const std::string& name, const std::optional<Eigen::Vector3d>& value, const Key& key);

  template <class Options>
  void section(const std::string& name, Options& options, const std::string& doc) {
    describe(name, options, doc, "[", "]");
  }

  template <class Options>
  void tables(const std::string& name, std::vector<Options>&, const std::string& doc) {
    Options defaults;
    describe(name, defaults, doc, "[[", "]]");
  }

  template <class Body>
  void when(const std::string& name, const std::string&, const std::string& wanted, Body&& body,
            bool = false) {
    condition_ = "for " + name + " \"" + wanted + "\": ";
    body();
    condition_.clear();
  }

  std::string text() const;

 private:
  template <class Options>
  void describe(const std::string& name, Options& options, const std::string& doc, const char* open,
                const char* close) {
    OptionsDocumenter inner(path_.empty() ? name : path_ + "." + name);
    declare(inner, options);
    sections_ += "\n## " + (open + inner.path_ + close) + "\n" + doc + "\n" + inner.text();
  }
  void row(const std::string& name, const std::string& type, const std::string& value, const Key& key);

  std::string path_, condition_;
  std::string rows_, sections_;
};

template <class Options>
std::string options_documentation() {
  Options defaults;
  OptionsDocumenter documenter;
  declare(documenter, defaults);
  return documenter.text();
}

}  // namespace windhover::io
