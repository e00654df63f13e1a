#include "app/rotor_output.h"

#include <cmath>

#include "base/errors.h"

namespace windhover::app {
namespace {

/// What is averaged first: the loads in this order; then the strips' and the sections' values.
enum Value { thrust, torque, hub_thrust, hub_torque, n_loads };

const std::vector<std::string> kRevolutionColumns = {"step", "time_s", "revolution", "rpm", "thrust_N", "torque_Nm",
                                                     "CT", "CP", "hub_thrust_N", "hub_torque_Nm"};
const std::vector<std::string> kStripColumns = {"step", "time_s", "blade", "r_over_R", "chord_m",
                                                "dT_dr_N_m", "dQ_dr_N", "normal_coefficient"};
const std::vector<std::string> kPressureColumns = {"step", "time_s", "blade", "r_over_R", "x_over_c", "side", "Cp"};

}  // namespace

RotorOutput::Tables::Tables(const std::filesystem::path& directory, const std::string& name, const std::vector<std::string>& columns,
                            MPI_Comm comm, std::optional<std::int64_t> last_step)
    : now(directory / (name + ".csv"), columns, comm, last_step), mean(directory / (name + "_mean.csv"), columns, comm, last_step) {}

RotorOutput::RotorOutput(const Case& c, const mesh::Mesh& mesh, const std::filesystem::path& directory,
                         std::optional<std::int64_t> last_step)
    : case_(c), comm_(mesh.comm) {
  for (const MeshRotor& rotor : mesh_rotors(c, mesh)) add_rotor(rotor, mesh, directory, last_step);
}

void RotorOutput::add_rotor(const MeshRotor& rotor, const mesh::Mesh& mesh, const std::filesystem::path& directory,
                            std::optional<std::int64_t> last_step) {
  const auto name = [&](const char* what) { return fmt::format("rotor_{}_{}", rotor.options->name, what); };
  Rotor r{rotor, {directory / (name("revolutions") + ".csv"), kRevolutionColumns, comm_, last_step}, {}, {}, {}, {}, RevolutionMean(0)};
  size_t n_values = n_loads;
  const OutputOptions& output = case_.output;
  if (output.span_strips > 0 || !output.section_r_over_R.empty()) {
    const BladeFaces faces(case_, mesh, rotor);
    points_.push_back({rotor.blades, mesh.patches[rotor.blades].blocks});
    points_.push_back({rotor.blades, {}});
    if (output.span_strips > 0) {
      r.strips.emplace(faces, output.span_strips);
      r.strip_tables.emplace(directory, name("strips"), kStripColumns, comm_, last_step);
      n_values += BladeStrips::kValues * r.strips->all().size();
    }
    if (!output.section_r_over_R.empty()) {
      r.pressures.emplace(faces, mesh, case_.fluid.length_m, output.section_r_over_R);
      r.pressure_tables.emplace(directory, name("sections"), kPressureColumns, comm_, last_step);
      n_values += r.pressures->points().size();
      points_.back().blocks = r.pressures->blocks();
    }
  }
  r.mean = RevolutionMean(n_values);
  rotors_.push_back(std::move(r));
}

std::vector<double> RotorOutput::revolution_row(const Rotor& r, const Revolution& revolution) const {
  const double rpm = 60 / revolution.period_s, radius = r.rotor.options->blade.radius_m;
  const std::vector<double>& mean = revolution.mean;
  return {double(step_), revolution.end_s, double(revolution.number), rpm, mean[thrust], mean[torque],
          thrust_coefficient(mean[thrust], rpm, case_.fluid.density_kg_m3, radius),
          power_coefficient(mean[torque], rpm, case_.fluid.density_kg_m3, radius), mean[hub_thrust], mean[hub_torque]};
}

void RotorOutput::add_surface_values(size_t i, double rpm, std::span<const std::vector<fluid::State<double>>> states,
                                     std::vector<double>& values) const {
  const Scales scales(case_.fluid);
  const auto pressures = [&](size_t set) {
    std::vector<double> p;
    for (const auto& s : states[set]) p.push_back(scales.pressure() * s.p - case_.fluid.pressure_Pa());
    return p;
  };
  const auto add = [&](const std::vector<double>& more) { values.insert(values.end(), more.begin(), more.end()); };
  if (rotors_[i].strips) add(rotors_[i].strips->values(pressures(2 * i), rpm, comm_));
  if (rotors_[i].pressures) add(rotors_[i].pressures->values(pressures(2 * i + 1), rpm, comm_));
}

std::vector<RotorLoads> RotorOutput::step(fluid::FlowSolver& solver, const std::vector<fluid::PatchFlux>& fluxes,
                                          const fluid::Frames& frames) {
  step_ = solver.state().step;
  time_s_ = solver.state().time * Scales(case_.fluid).time();
  written_ = false;
  std::vector<std::vector<fluid::State<double>>> states;
  if (!points_.empty()) states = solver.euler().surface_states(solver.state().q, frames, points_);
  std::vector<RotorLoads> all;
  for (size_t i = 0; i < rotors_.size(); ++i) {
    Rotor& r = rotors_[i];
    const RotorLoads loads = rotor_loads(case_, r.rotor, fluxes, frames);
    const double turned = step_ == 0 ? 0 : r.rotor.options->spin() * std::remainder(loads.angle_deg - r.angle_deg, 360);
    r.angle_deg = loads.angle_deg;
    std::vector<double> values = {loads.thrust_N, loads.torque_Nm, loads.hub_thrust_N, loads.hub_torque_Nm};
    add_surface_values(i, loads.rpm, states, values);
    if (const auto revolution = r.mean.add(time_s_, turned, values)) {
      r.revolutions.append(revolution_row(r, *revolution));
      write_surface(r, true, revolution->end_s, revolution->mean);
    }
    all.push_back(loads);
  }
  return all;
}

void RotorOutput::write_surface(Rotor& r, bool mean, double time_s, std::span<const double> values) {
  values = values.subspan(n_loads);
  const double step = static_cast<double>(step_);
  if (r.strips) {
    io::CsvTable& table = mean ? r.strip_tables->mean : r.strip_tables->now;
    for (const BladeStrip& s : r.strips->all()) {
      table.append(std::vector<double>{step, time_s, double(s.blade), s.r_over_R, s.chord_m, values[0], values[1], values[2]});
      values = values.subspan(BladeStrips::kValues);
    }
  }
  if (r.pressures) {
    io::CsvTable& table = mean ? r.pressure_tables->mean : r.pressure_tables->now;
    for (const SectionPoint& p : r.pressures->points()) {
      table.append(std::vector<double>{step, time_s, double(p.blade), p.r_over_R, p.x_over_c, double(p.side), values[0]});
      values = values.subspan(1);
    }
  }
}

void RotorOutput::write() {
  if (written_) return;
  written_ = true;
  for (Rotor& r : rotors_) write_surface(r, false, time_s_, r.mean.values());
}

nlohmann::ordered_json RotorOutput::summary() const {
  nlohmann::ordered_json all = nlohmann::ordered_json::object();
  for (const Rotor& r : rotors_) {
    auto& rotor = all[r.rotor.options->name];
    rotor["revolutions"] = r.mean.latest() ? r.mean.latest()->number : 0;
    if (!r.mean.latest()) continue;
    const std::vector<double> row = revolution_row(r, *r.mean.latest());
    auto& latest = rotor["latest_revolution"];
    for (size_t i : {1, 3, 4, 5, 6, 7, 8, 9}) latest[kRevolutionColumns[i]] = row[i];
  }
  return all;
}

std::vector<double> RotorOutput::state() const {
  std::vector<double> all;
  for (const Rotor& r : rotors_) {
    all.push_back(r.angle_deg);
    const std::vector<double> mean = r.mean.state();
    all.insert(all.end(), mean.begin(), mean.end());
  }
  return all;
}

void RotorOutput::restore(std::span<const double> state) {
  size_t expected = 0;
  for (const Rotor& r : rotors_) expected += 1 + r.mean.state_size();
  if (state.size() != expected)
    throw UserError("the checkpoint's averages over revolutions are of other [[rotor]], output.span_strips or output.section_r_over_R");
  for (Rotor& r : rotors_) {
    r.angle_deg = state.front();
    r.mean.restore(state.subspan(1, r.mean.state_size()));
    state = state.subspan(1 + r.mean.state_size());
  }
}

}  // namespace windhover::app
