// How a case key is declared: once, in a function template `declare(visitor, options)` beside a plain struct of
// values. The visitors read the struct, write it, and document it (io/options_reader.h, options_writer.h,
// options_documenter.h).
//
//   template <class V> void declare(V& v, GasOptions& o) {
//     v.key("gamma", o.gamma, {.doc = "ratio of specific heats", .above = 1});
//   }
//
// What a visitor offers: key (a value), section (a table with its own struct), tables (an array of tables) and
// when (keys that exist only for one value of another key, or that are also allowed, unused, where that key is written
// out with another value).
#pragma once
#include <limits>
#include <string>
#include <vector>

namespace windhover {

/// What is declared about a key besides its name and its value, which holds the default.
struct Key {
  std::string doc;
  double above = -std::numeric_limits<double>::infinity();  ///< the value must be greater
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  std::vector<std::string> choices = {};  ///< the valid strings; empty: any
};

/// A dotted key, and what it takes in turn: values as TOML text.
struct ValueList {
  std::string key;
  std::vector<std::string> values;
};

bool in_range(const Key& key, double value);

/// The range in words, such as "> 0" or "from 0 to 1"; empty when there is none.
std::string range_text(const Key& key);

/// `"a", "b", "c"`
std::string quoted_list(const std::vector<std::string>& names);

/// The valid name with the smallest edit distance, or nothing when none is near.
std::string nearest_name(const std::string& name, const std::vector<std::string>& valid);

/// ` (did you mean "gamma"?)`, or when no valid name is near ` (valid: "gamma", ...)`.
std::string suggestion(const std::string& name, const std::vector<std::string>& valid);

}  // namespace windhover
