#include "app/flow_fields.h"

#include <cmath>
#include <unordered_map>

#include "app/wind.h"
#include "mesh/cell_shape.h"
#include "mesh/face_geometry.h"

namespace windhover::app {
namespace {

using fluid::State;
using mesh::Index;

constexpr std::uint8_t kVtkTriangle = 5, kVtkQuad = 9;

std::uint8_t vtk_type(mesh::CellType type) {
  switch (type) {
    case mesh::CellType::tetrahedron: return 10;
    case mesh::CellType::hexahedron: return 12;
    case mesh::CellType::prism: return 13;
    case mesh::CellType::pyramid: return 14;
  }
  return 0;
}

/// What turns the flow solver's numbers into what is written.
struct Air {
  Scales scales;
  double gamma;
  Vec3 wind;  ///< what wind.change has added: the solver's velocities are relative to it
};

/// A block with its arrays, filled cell by cell; points are numbered as they come.
class BlockBuilder {
 public:
  BlockBuilder(std::string name, const mesh::Mesh& mesh, const mesh::FrameState& frame, const Air& air)
      : mesh_(mesh), frame_(frame), air_(air) {
    block_.name = std::move(name);
    block_.arrays = {{"density", 1, {}}, {"pressure_Pa", 1, {}}, {"velocity", 3, {}}, {"mach", 1, {}}};
  }

  void add_cell(std::uint8_t type, std::span<const Index> points, State<double> s) {
    s.u += air_.wind.x(), s.v += air_.wind.y(), s.w += air_.wind.z();
    for (const Index p : points) {
      const auto [entry, fresh] = number_.try_emplace(p, static_cast<std::int64_t>(number_.size()));
      if (fresh) {
        const Vec3 x = air_.scales.length * frame_.position(mesh_.point[p]);
        block_.points.insert(block_.points.end(), x.data(), x.data() + 3);
      }
      block_.connectivity.push_back(entry->second);
    }
    block_.offsets.push_back(static_cast<std::int64_t>(block_.connectivity.size()));
    block_.types.push_back(type);
    const auto put = [&](int array, double value) { block_.arrays[array].values.push_back(static_cast<float>(value)); };
    put(0, air_.scales.density * s.rho);
    put(1, air_.scales.pressure() * s.p);
    for (const double component : {s.u, s.v, s.w}) put(2, air_.scales.velocity * component);
    put(3, std::sqrt(fluid::speed_squared(s) * s.rho / (air_.gamma * s.p)));
  }

  io::FieldBlock take() { return std::move(block_); }

 private:
  const mesh::Mesh& mesh_;
  const mesh::FrameState& frame_;
  const Air& air_;
  io::FieldBlock block_;
  std::unordered_map<Index, std::int64_t> number_;
};

/// The points of the cell's face whose area vector is `area` (boundary faces carry no points of their own).
std::vector<Index> face_points(const mesh::Mesh& mesh, Index cell, const Vec3& area) {
  const Index* points = &mesh.cell_point[mesh.cell_point_start[cell]];
  std::vector<Index> best;
  double smallest = 0;
  for (const auto& face : mesh::faces_of(mesh.type[cell])) {
    std::vector<Index> candidate;
    std::vector<Vec3> corners;
    for (int i = 0; i < face.n; ++i) {
      candidate.push_back(points[face.point[i]]);
      corners.push_back(mesh.point[candidate.back()]);
    }
    const double difference = (mesh::face_geometry(corners).area - area).norm();
    if (best.empty() || difference < smallest) smallest = difference, best = candidate;
  }
  return best;
}

io::FieldBlock patch_block(fluid::FlowSolver& solver, const fluid::Frames& frames, int p, const Air& air) {
  const mesh::Mesh& mesh = solver.euler().mesh();
  const auto& patch = mesh.patches[p];
  BlockBuilder builder(patch.name, mesh, frames[patch.zone], air);
  const auto states = solver.euler().patch_states(solver.state().q, frames, p);
  size_t next = 0;
  for (const auto& b : patch.blocks)
    for (int i = 0; i < b.count; ++i) {
      const auto points = face_points(mesh, b.cell[0][i], {b.area[0][i], b.area[1][i], b.area[2][i]});
      builder.add_cell(points.size() == 3 ? kVtkTriangle : kVtkQuad, points, states[next++]);
    }
  return builder.take();
}

}  // namespace

std::vector<io::FieldBlock> flow_fields(const Case& c, fluid::FlowSolver& solver, const fluid::Frames& frames) {
  const mesh::Mesh& mesh = solver.euler().mesh();
  const Scales scales(c.fluid);
  const Air air{scales, c.fluid.gamma, wind_change(c.wind, solver.state().time * scales.time()) / scales.velocity};
  std::vector<BlockBuilder> zones;
  for (size_t z = 0; z < mesh.zones.size(); ++z)
    zones.emplace_back(mesh.zones[z].name, mesh, frames[z], air);
  const double* q = nullptr;
  petsc(VecGetArrayRead(solver.state().q, &q));
  for (Index i = 0; i < mesh.n_owned; ++i) {
    const Index first = mesh.cell_point_start[i];
    zones[mesh.cell_zone[i]].add_cell(vtk_type(mesh.type[i]),
                                      {&mesh.cell_point[first], size_t(mesh.cell_point_start[i + 1] - first)},
                                      fluid::primitive(q + 5 * i, c.fluid.gamma));
  }
  petsc(VecRestoreArrayRead(solver.state().q, &q));
  std::vector<io::FieldBlock> blocks;
  for (auto& zone : zones) blocks.push_back(zone.take());
  for (size_t p = 0; p < mesh.patches.size(); ++p) {
    if (is_wall(c, mesh.patches[p].name))
      blocks.push_back(patch_block(solver, frames, static_cast<int>(p), air));
  }
  return blocks;
}

}  // namespace windhover::app
