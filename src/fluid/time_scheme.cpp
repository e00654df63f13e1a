#include "fluid/time_scheme.h"

#include "base/errors.h"

namespace windhover::fluid {
namespace {
constexpr double kGamma = 0.29289321881345247560;  // 1 − 1/√2
}

const TimeScheme kTimeSchemes[5] = {
    {"crank_nicolson", 2, 2, true, false, true, {{0, 0}, {0.5, 0.5}}, {}, {0, 1}},
    {"backward_euler", 1, 1, true, false, false, {{1}}, {}, {1}},
    {"bdf2", 2, 1, true, true, false, {{1}}, {}, {1}},
    {"sdirk2", 2, 2, true, false, false, {{kGamma, 0}, {1 - kGamma, kGamma}}, {}, {kGamma, 1}},
    {"ssp_rk3", 3, 3, false, false, false, {{0, 0, 0}, {1, 0, 0}, {0.25, 0.25, 0}}, {1.0 / 6, 1.0 / 6, 2.0 / 3}, {0, 1, 0.5}},
};

const TimeScheme& time_scheme(const std::string& name) {
  std::string names;
  for (const TimeScheme& scheme : kTimeSchemes) {
    if (name == scheme.name) return scheme;
    names += std::string(names.empty() ? "" : ", ") + scheme.name;
  }
  throw UserError("time.scheme: '{}' is not one of {}", name, names);
}

Bdf2Coefficients bdf2_coefficients(double r) {
  const double d = 1 + 2 * r;
  return {(1 + r) * (1 + r) / d, -r * r / d, (1 + r) / d};
}

}  // namespace windhover::fluid
