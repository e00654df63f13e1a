#include "app/flow_checkpoint.h"

#include <algorithm>

#include "base/collective.h"
#include "base/errors.h"
#include "io/checkpoint.h"

namespace windhover::app {
FlowCheckpoint::FlowCheckpoint(const Case& c, const mesh::Mesh& mesh)
    : case_(c), mesh_(mesh), order_(mesh.file_cell, mesh.comm) {}

std::vector<double> FlowCheckpoint::rows_of(Vec q) const {
  const double* v = nullptr;
  petsc(VecGetArrayRead(q, &v));
  auto rows = order_.to_rows({v, size_t(fluid::kVariables * mesh_.n_owned)}, fluid::kVariables);
  petsc(VecRestoreArrayRead(q, &v));
  return rows;
}

void FlowCheckpoint::set_items(std::span<const double> rows, Vec q) const {
  const auto items = order_.to_items(rows, fluid::kVariables);
  double* v = nullptr;
  petsc(VecGetArrayWrite(q, &v));
  std::copy(items.begin(), items.end(), v);
  petsc(VecRestoreArrayWrite(q, &v));
}

void FlowCheckpoint::write(const std::filesystem::path& directory, const fluid::FlowState& state,
                           const fluid::Frames& frames, const Memory& memory) const {
  const Scales s(case_.fluid);
  io::CheckpointWriter out(directory, state.step, mesh_.comm);
  out.attribute("mesh_hash", mesh_.hash);
  out.attribute("cells", std::int64_t(mesh_.n_global));
  out.attribute("step", std::int64_t(state.step));
  out.attribute("time_s", state.time * s.time());
  out.attribute("dt_s", state.last_step * s.time());
  out.attribute("time", state.time);  // nondimensional, to the last bit
  out.attribute("last_step", state.last_step);
  out.attribute("step_before", state.step_before);
  out.attribute("density_kg_m3", s.density);
  out.attribute("sound_speed_m_s", s.velocity);
  out.attribute("length_m", s.length);
  out.attribute("gamma", case_.fluid.gamma);
  std::vector<double> R, x;
  for (const auto& f : frames)
    for (int i = 0; i < 3; ++i) {
      x.push_back(s.length * f.x[i]);
      for (int j = 0; j < 3; ++j) R.push_back(f.R(i, j));
    }
  out.attribute("zone_R", R);
  out.attribute("zone_x_m", x);
  out.array("q", rows_of(state.q), fluid::kVariables);
  out.array("q_previous", rows_of(state.previous), fluid::kVariables);
  if (state.step_before > 0) out.array("q_earlier", rows_of(state.earlier), fluid::kVariables);
  if (state.remainder) out.array("remainder", rows_of(state.remainder), fluid::kVariables);
  std::vector<double> centroid, volume, zone(mesh_.cell_zone.begin(), mesh_.cell_zone.begin() + mesh_.n_owned);
  for (mesh::Index c = 0; c < mesh_.n_owned; ++c) {
    for (int k = 0; k < 3; ++k) centroid.push_back(s.length * mesh_.centroid[c][k]);
    volume.push_back(s.length * s.length * s.length * mesh_.volume[c]);
  }
  out.array("centroid_m", order_.to_rows(centroid, 3), 3);
  out.array("zone", order_.to_rows(zone, 1), 1);
  out.array("volume_m3", order_.to_rows(volume, 1), 1);
  const auto remember = [&](const char* name, std::span<const double> all) {
    if (!all.empty()) out.array(name, rank_of(mesh_.comm) == 0 ? all : all.first(0), 1);
  };
  remember("third_derivative", {&state.third, 1});
  remember("averages", memory.averages);
  remember("vehicle", memory.vehicle);
  remember("step_control", memory.step);
  out.finish();
}

Memory FlowCheckpoint::read(const std::filesystem::path& directory, fluid::FlowState& state) const {
  const auto path = io::newest_checkpoint(directory);
  if (!path) throw UserError("{}: no checkpoint to restart from", (directory / "checkpoint").string());
  const io::CheckpointReader in(*path, mesh_.comm);
  if (in.attribute<std::uint64_t>("mesh_hash") != mesh_.hash)
    throw UserError("{}: is of another mesh than {} ({} cells there, {} here)", path->string(), case_.mesh.file,
                    in.attribute<std::int64_t>("cells"), mesh_.n_global);
  state.step = in.attribute<std::int64_t>("step");
  state.time = in.attribute<double>("time");
  state.last_step = in.attribute<double>("last_step");
  const auto load = [&](const char* name, Vec q) {
    set_items(in.array(name, fluid::kVariables, order_.first_row(), order_.n_rows()), q);
  };
  load("q", state.q);
  load("q_previous", state.previous);
  if (state.earlier && in.has_array("q_earlier")) {  // not from explicit runs
    load("q_earlier", state.earlier);
    state.step_before = in.attribute<double>("step_before");
  }
  if (state.remainder && in.has_array("remainder")) load("remainder", state.remainder);
  const auto recall = [&](const char* name) {
    return in.has_array(name) ? in.array(name, 1, 0, in.rows(name)) : std::vector<double>();
  };
  const auto third = recall("third_derivative");
  state.third = third.empty() ? 0 : third[0];
  return {recall("averages"), recall("vehicle"), recall("step_control")};
}

}  // namespace windhover::app
