#include "coupling/schemes.h"

#include <algorithm>

#include "base/errors.h"
#include "base/options.h"

namespace windhover::coupling {
namespace {

constexpr SchemeEntry kTable[] = {
    {"loose", "", Prediction::hold, false, make_single_pass},
    {"loose-extrapolated", "", Prediction::extrapolate, false, make_single_pass},
    {"strong", "constant", Prediction::best, true, make_constant},
    {"strong", "aitken", Prediction::best, true, make_aitken},
    {"strong", "anderson", Prediction::best, true, make_anderson},
    {"strong", "iqn-ils", Prediction::best, true, make_iqn_ils},
};

}  // namespace

std::vector<std::string> scheme_names() {
  std::vector<std::string> names;
  for (const SchemeEntry& entry : kTable)
    if (std::find(names.begin(), names.end(), entry.scheme) == names.end()) names.emplace_back(entry.scheme);
  return names;
}

std::vector<std::string> acceleration_names() {
  std::vector<std::string> names;
  for (const SchemeEntry& entry : kTable)
    if (entry.iterates) names.emplace_back(entry.acceleration);
  return names;
}

const SchemeEntry& find_scheme(const CouplingOptions& options) {
  for (const SchemeEntry& entry : kTable)
    if (options.scheme == entry.scheme && (!entry.iterates || options.acceleration == entry.acceleration)) return entry;
  if (options.scheme != "strong")
    throw UserError("coupling.scheme = \"{}\": is not one of {}", options.scheme, quoted_list(scheme_names()));
  throw UserError("coupling.acceleration = \"{}\": is not one of {}", options.acceleration,
                  quoted_list(acceleration_names()));
}

}  // namespace windhover::coupling
