// Two families of errors: what the user can mend (UserError, exit 2), and a solver that gave up
// (SolverFailure, exit 3; the last accepted state is saved before it is thrown). Bugs are assertions.
#pragma once
#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace windhover {

/// Something the user can mend. The message names file, key or place, the value, and what is allowed.
class UserError : public std::runtime_error {
 public:
  explicit UserError(const std::string& message) : std::runtime_error(message) {}
  template <class... Args>
  explicit UserError(fmt::format_string<Args...> format, Args&&... args)
      : std::runtime_error(fmt::format(format, std::forward<Args>(args)...)) {}
};

/// The solver gave up for the stated reason.
class SolverFailure : public std::runtime_error {
 public:
  explicit SolverFailure(const std::string& message) : std::runtime_error(message) {}
  template <class... Args>
  explicit SolverFailure(fmt::format_string<Args...> format, Args&&... args)
      : std::runtime_error(fmt::format(format, std::forward<Args>(args)...)) {}
};

}  // namespace windhover
