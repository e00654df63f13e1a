#include "app/rotor_output.h"

#include <cmath>

#include "base/errors.h"

namespace windhover::app {
namespace {

/// What is averaged: the loads in this order.
enum Value { thrust, torque, hub_thrust, hub_torque, n_values };

const std::vector<std::string> kRevolutionColumns = {"step", "time_s", "revolution", "rpm", "thrust_N", "torque_Nm",
                                                     "CT", "CP", "hub_thrust_N", "hub_torque_Nm"};

}  // namespace

RotorOutput::RotorOutput(const Case& c, const mesh::Mesh& mesh, const std::filesystem::path& directory,
                         std::optional<std::int64_t> last_step)
    : case_(c) {
  for (const MeshRotor& rotor : mesh_rotors(c, mesh))
    outputs_.push_back({rotor,
                        {directory / fmt::format("rotor_{}_revolutions.csv", rotor.options->name), kRevolutionColumns, mesh.comm, last_step},
                        RevolutionMean(n_values)});
}

std::vector<double> RotorOutput::revolution_row(const Output& output, const Revolution& revolution) const {
  const double rpm = 60 / revolution.period_s, radius = output.rotor.options->blade.radius_m;
  const std::vector<double>& mean = revolution.mean;
  return {revolution.end_s, double(revolution.number), rpm, mean[thrust], mean[torque],
          thrust_coefficient(mean[thrust], rpm, case_.fluid.density_kg_m3, radius),
          power_coefficient(mean[torque], rpm, case_.fluid.density_kg_m3, radius), mean[hub_thrust], mean[hub_torque]};
}

std::vector<RotorLoads> RotorOutput::step(std::int64_t step, double time_s, const std::vector<fluid::PatchFlux>& fluxes,
                                          const fluid::Frames& frames) {
  std::vector<RotorLoads> all;
  for (Output& output : outputs_) {
    const RotorLoads loads = rotor_loads(case_, output.rotor, fluxes, frames);
    const double turned = step == 0 ? 0 : output.rotor.options->spin() * std::remainder(loads.angle_deg - output.angle_deg, 360);
    output.angle_deg = loads.angle_deg;
    const double values[n_values] = {loads.thrust_N, loads.torque_Nm, loads.hub_thrust_N, loads.hub_torque_Nm};
    if (const auto revolution = output.mean.add(time_s, turned, values)) {
      std::vector<double> row = revolution_row(output, *revolution);
      row.insert(row.begin(), double(step));
      output.revolutions.append(row);
    }
    all.push_back(loads);
  }
  return all;
}

nlohmann::ordered_json RotorOutput::summary() const {
  nlohmann::ordered_json all = nlohmann::ordered_json::object();
  for (const Output& output : outputs_) {
    auto& rotor = all[output.rotor.options->name];
    rotor["revolutions"] = output.mean.latest() ? output.mean.latest()->number : 0;
    if (!output.mean.latest()) continue;
    const std::vector<double> row = revolution_row(output, *output.mean.latest());
    auto& latest = rotor["latest_revolution"];
    for (size_t i : {0, 2, 3, 4, 5, 6, 7, 8}) latest[kRevolutionColumns[i + 1]] = row[i];
  }
  return all;
}

std::vector<double> RotorOutput::state() const {
  std::vector<double> all;
  for (const Output& output : outputs_) {
    all.push_back(output.angle_deg);
    const std::vector<double> mean = output.mean.state();
    all.insert(all.end(), mean.begin(), mean.end());
  }
  return all;
}

void RotorOutput::restore(std::span<const double> state) {
  constexpr size_t size = 1 + RevolutionMean::state_size(n_values);
  if (state.size() != size * outputs_.size())
    throw UserError("the checkpoint's averages are not of the case's {} rotors", outputs_.size());
  for (Output& output : outputs_) {
    output.angle_deg = state.front();
    output.mean.restore(state.subspan(1, size - 1));
    state = state.subspan(size);
  }
}

}  // namespace windhover::app
