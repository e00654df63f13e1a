// The coupling schemes by name.
#pragma once
#include <string>
#include <vector>

#include "coupling/scheme.h"

namespace windhover::coupling {

/// Where the first loads of a step come from.
enum class Prediction { hold, extrapolate, best };

struct SchemeEntry {
  const char* scheme;
  const char* acceleration;  ///< of strong schemes, otherwise empty
  Prediction prediction;
  bool iterates;
  std::unique_ptr<Scheme> (*make)(const CouplingOptions&, int size, int motions);
};

std::vector<std::string> scheme_names();
std::vector<std::string> acceleration_names();

/// UserError naming the valid ones when there is no such scheme.
const SchemeEntry& find_scheme(const CouplingOptions& options);

}  // namespace windhover::coupling
