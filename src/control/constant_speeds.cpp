#include "control/constant_speeds.h"

#include "base/errors.h"
#include "base/options.h"

namespace windhover::control {
namespace {

class ConstantSpeeds : public Controller {
 public:
  explicit ConstantSpeeds(Command command) : command_(std::move(command)) {}
  int state_size() const override { return 0; }
  Command evaluate(const Measurement&, const Setpoint&, std::span<const double>, std::span<double>) const override {
    return command_;
  }
  std::vector<double> state_for(const Measurement&, const Setpoint&, const Command&) const override { return {}; }

 private:
  Command command_;
};

}  // namespace

std::unique_ptr<Controller> make_constant_speeds(const ControllerOptions& options, const Airframe& airframe,
                                                 const std::string& prefix) {
  Command command;
  std::vector<std::string> names;
  for (const RotorModel& rotor : airframe.rotors) {
    names.push_back(rotor.name);
    const auto speed = options.speed_rad_s.find(rotor.name);
    if (speed == options.speed_rad_s.end())
      throw UserError("{}speed_rad_s: no speed for rotor \"{}\"", prefix, rotor.name);
    command.rotor_speed.push_back(speed->second);
  }
  for (const auto& [name, speed] : options.speed_rad_s)
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw UserError("{}speed_rad_s.{}: no such rotor{}", prefix, name, suggestion(name, names));
  return std::make_unique<ConstantSpeeds>(std::move(command));
}

}  // namespace windhover::control
