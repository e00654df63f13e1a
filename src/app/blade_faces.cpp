#include "app/blade_faces.h"

#include <cmath>
#include <numbers>

#include "mesh/cell_shape.h"

namespace windhover::app {
namespace {

constexpr double kRadians = std::numbers::pi / 180;

const geometry::RotorOptions& checked(const geometry::RotorOptions& rotor) {
  geometry::validate_stations(rotor.blade);
  return rotor;
}

/// The corners of a boundary face, in metres.
std::vector<Vec3> corners_of(const mesh::Mesh& mesh, const mesh::FaceBlock& block, int lane, double length_m) {
  const mesh::Index cell = block.cell[0][lane];
  const mesh::ShapeFace& shape = mesh::faces_of(mesh.type[cell])[block.side[lane]];
  std::vector<Vec3> corners;
  for (int k = 0; k < shape.n; ++k)
    corners.push_back(length_m * mesh.point[mesh.cell_point[mesh.cell_point_start[cell] + shape.point[k]]]);
  return corners;
}

}  // namespace

BladeFaces::BladeFaces(const Case& c, const mesh::Mesh& mesh, const MeshRotor& rotor)
    : density_kg_m3_(c.fluid.density_kg_m3), rotor_(rotor), blades_(checked(*rotor.options), 1) {
  const geometry::RotorOptions& options = *rotor.options;
  const Eigen::Matrix3d axes = geometry::rotor_axes(options);
  for (int k = 0; k < options.blade.count; ++k) {
    const double angle = options.angle_deg * kRadians + 2 * std::numbers::pi * k / options.blade.count;
    along_.push_back(std::cos(angle) * axes.col(0) + std::sin(angle) * axes.col(1));
  }
  for (const mesh::FaceBlock& block : mesh.patches[rotor.blades].blocks)
    for (int lane = 0; lane < block.count; ++lane) {
      std::vector<Vec3> corners = corners_of(mesh, block, lane, c.fluid.length_m);
      Vec3 mean = Vec3::Zero();
      for (Vec3& corner : corners) {
        corner -= options.center_m;
        mean += corner / corners.size();
      }
      BladeFace face{blade_of(mean), {}, &block, lane};
      for (size_t k = 0; corners.size() > 3 && k < corners.size(); ++k)
        face.triangles.push_back({mean, corners[k], corners[(k + 1) % corners.size()]});
      if (corners.size() == 3) face.triangles.push_back(std::move(corners));
      faces_.push_back(std::move(face));
    }
}

int BladeFaces::blade_of(const Vec3& place) const {
  int best = 0;
  for (int k = 1; k < static_cast<int>(along_.size()); ++k)
    if (along_[k].dot(place) > along_[best].dot(place)) best = k;
  return best;
}

geometry::BladeSection BladeFaces::section(int blade, double r_m) const {
  geometry::BladeSection section = blades_.section(blade, r_m / std::cos(rotor().blade.precone_deg * kRadians));
  section.quarter_chord -= rotor().center_m;
  return section;
}

double BladeFaces::dynamic_pressure(double rpm, double r_m) const {
  return 0.5 * density_kg_m3_ * std::pow(rpm / 60 * 2 * std::numbers::pi * r_m, 2);
}

}  // namespace windhover::app
