#include "control/controllers.h"

#include "base/errors.h"
#include "base/options.h"
#include "control/cascade.h"
#include "control/constant_speeds.h"

namespace windhover::control {
namespace {

struct Entry {
  const char* name;
  std::unique_ptr<Controller> (*make)(const ControllerOptions&, const Airframe&, const std::string& prefix);
};

constexpr Entry kTable[] = {
    {"none", make_constant_speeds},
    {"cascade", make_cascade},
};

}  // namespace

std::vector<std::string> controller_names() {
  std::vector<std::string> names;
  for (const Entry& entry : kTable) names.emplace_back(entry.name);
  return names;
}

std::unique_ptr<Controller> make_controller(const ControllerOptions& options, const Airframe& airframe,
                                            const std::string& prefix) {
  for (const Entry& entry : kTable)
    if (options.kind == entry.name) return entry.make(options, airframe, prefix);
  throw UserError("{}kind = \"{}\": no such controller{}", prefix, options.kind,
                  suggestion(options.kind, controller_names()));
}

}  // namespace windhover::control
