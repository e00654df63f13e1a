#include "app/blade_strips.h"

namespace windhover::app {
namespace {

using Outline = std::vector<Vec3>;

/// The part of a convex outline where direction·r >= least.
Outline clip(const Outline& outline, const Vec3& direction, double least) {
  Outline rest;
  for (size_t k = 0; k < outline.size(); ++k) {
    const Vec3 &a = outline[k], &b = outline[(k + 1) % outline.size()];
    const double da = direction.dot(a) - least, db = direction.dot(b) - least;
    if (da >= 0) rest.push_back(a);
    if ((da < 0) != (db < 0)) rest.push_back(a + da / (da - db) * (b - a));
  }
  return rest;
}

/// ∫ n dA and ∫ r × n dA of a plane outline.
std::pair<Vec3, Vec3> area_and_moment(const Outline& outline) {
  Vec3 area = Vec3::Zero(), moment = Vec3::Zero();
  for (size_t k = 2; k < outline.size(); ++k) {
    const Vec3 part = (outline[k - 1] - outline[0]).cross(outline[k] - outline[0]) / 2;
    area += part;
    moment += ((outline[0] + outline[k - 1] + outline[k]) / 3).cross(part);
  }
  return {area, moment};
}

}  // namespace

BladeStrips::BladeStrips(const BladeFaces& faces, int strips_per_blade) : per_blade_(strips_per_blade) {
  const geometry::BladeOptions& blade = faces.rotor().blade;
  root_m_ = blade.r_over_R.front() * blade.radius_m;
  width_m_ = (blade.radius_m - root_m_) / per_blade_;
  for (int k = 0; k < blade.count; ++k)
    for (int i = 0; i < per_blade_; ++i) {
      const double r = border_m(i) + width_m_ / 2;
      strips_.push_back({k, r / blade.radius_m, faces.section(k, r).chord});
      dynamic_pressure_.push_back(faces.dynamic_pressure(1, r));
    }
  for (size_t f = 0; f < faces.all().size(); ++f)
    for (const Outline& triangle : faces.all()[f].triangles) add(faces, static_cast<int>(f), triangle);
}

void BladeStrips::add(const BladeFaces& faces, int number, const Outline& triangle) {
  const int blade = faces.all()[number].blade, spin = faces.rotor().spin();
  const Vec3 axis = faces.rotor().axis.normalized(), along = faces.along(blade);
  for (int i = 0; i < per_blade_; ++i) {
    Outline part = i == 0 ? triangle : clip(triangle, along, border_m(i));
    if (i < per_blade_ - 1) part = clip(part, -along, -border_m(i + 1));
    if (part.size() < 3) continue;
    const int strip = blade * per_blade_ + i;
    const auto [area, moment] = area_and_moment(part);  // into the blade, where the pressure pushes
    const Vec3 up = faces.section(blade, border_m(i) + width_m_ / 2).up;
    parts_.push_back({number, strip, {axis.dot(area), -spin * axis.dot(moment), up.dot(area)}});
  }
}

std::vector<double> BladeStrips::values(std::span<const double> pressures, double rpm, MPI_Comm comm) const {
  std::vector<double> values(kValues * strips_.size(), 0);
  for (const Part& part : parts_)
    for (int k = 0; k < kValues; ++k) values[kValues * part.strip + k] += pressures[part.face] * part.load[k] / width_m_;
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_SUM, comm);
  for (size_t s = 0; s < strips_.size(); ++s) values[kValues * s + 2] /= rpm * rpm * dynamic_pressure_[s] * strips_[s].chord_m;
  return values;
}

}  // namespace windhover::app
