#include "geometry/mass.h"

#include <cmath>
#include <numbers>

#include "geometry/airframe.h"
#include "geometry/stations.h"

namespace windhover::geometry {
namespace {

constexpr double kPi = std::numbers::pi;

/// A body's volume and the diagonal of ∫ r rᵀ dV about its centre; the products vanish.
struct Moments {
  double volume = 0;
  Vec3 square = Vec3::Zero();
};

Moments& operator+=(Moments& a, const Moments& b) {
  a.volume += b.volume;
  a.square += b.square;
  return a;
}

/// About a common centre: copies of a body at all (±x, ±y, ±z) of the shift, so that products cancel.
Moments copies(int count, const Moments& m, const Vec3& shift) {
  return {count * m.volume, count * (m.square + m.volume * shift.cwiseAbs2())};
}

Moments box(const Vec3& size) {
  const double volume = size.prod();
  return {volume, volume / 12 * size.cwiseAbs2()};
}

/// A box rounded by a ball of radius r: its core, a slab on each face, a quarter of a cylinder on each edge, and an eighth of
/// a ball on each corner. Centroids of the quarters lie 4r/(3π), of the eighths 3r/8 beyond the core.
Moments rounded_box(const Vec3& size, double r) {
  const Vec3 core = size - Vec3::Constant(2 * r);
  Moments m = box(core);
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    Vec3 slab = core, shift = Vec3::Zero();
    slab[i] = r;
    shift[i] = (core[i] + r) / 2;
    m += copies(2, box(slab), shift);
    const double c = 4 * r / (3 * kPi), area = kPi * r * r / 4;  // along axis i; about its centroid r²/4 − c² per area
    Moments quarter{area * core[i], Vec3::Zero()};
    quarter.square[i] = quarter.volume * core[i] * core[i] / 12;
    quarter.square[j] = quarter.square[k] = quarter.volume * (r * r / 4 - c * c);
    shift = core / 2 + Vec3::Constant(c);
    shift[i] = 0;
    m += copies(4, quarter, shift);
  }
  const double c = 3 * r / 8, volume = kPi * r * r * r / 6;
  const Moments eighth{volume, Vec3::Constant(volume * (r * r / 5 - c * c))};
  m += copies(8, eighth, core / 2 + Vec3::Constant(c));
  return m;
}

/// Along z.
Moments cylinder(double r, double length) {
  const double volume = kPi * r * r * length;
  return {volume, volume * Vec3(r * r / 4, r * r / 4, length * length / 12)};
}

Moments capsule(double r, double length) {
  const double c = 3 * r / 8, volume = 2 * kPi * r * r * r / 3;
  Moments m = cylinder(r, length);
  m += copies(2, {volume, volume * Vec3(r * r / 5, r * r / 5, r * r / 5 - c * c)}, Vec3(0, 0, length / 2 + c));
  return m;
}

Moments moments_of(const PartOptions& p) {
  const double length = (p.to_m - p.from_m).norm();
  if (p.kind == "box") return rounded_box(p.size_m, p.rounding_m);
  if (p.kind == "cylinder") return cylinder(p.radius_m, length);
  if (p.kind == "capsule") return capsule(p.radius_m, length);
  const double volume = 4 * kPi / 3 * p.radii_m.prod();
  return {volume, volume / 5 * p.radii_m.cwiseAbs2()};
}

Eigen::Matrix3d tensor(const Eigen::Matrix3d& second_moments) {
  return second_moments.trace() * Eigen::Matrix3d::Identity() - second_moments;
}

/// Of a body of revolution: squares across and along the axis.
Eigen::Matrix3d about_axis(const Vec3& axis, double across, double along) {
  const Vec3 a = axis.normalized();
  return across * Eigen::Matrix3d::Identity() + (along - across) * a * a.transpose();
}

}  // namespace

MassProperties combined(const std::vector<MassProperties>& bodies) {
  MassProperties all;
  for (const auto& b : bodies) {
    all.mass_kg += b.mass_kg;
    all.center_m += b.mass_kg * b.center_m;
  }
  if (all.mass_kg == 0) return {};
  all.center_m /= all.mass_kg;
  for (const auto& b : bodies) {
    const Vec3 d = b.center_m - all.center_m;
    all.inertia_kg_m2 += b.inertia_kg_m2 + b.mass_kg * tensor(d * d.transpose());
  }
  return all;
}

MassProperties mass_of(const PartOptions& part) {
  const Moments m = moments_of(part);
  const double mass = part.density_kg_m3 > 0 ? part.density_kg_m3 * m.volume : part.mass_kg, density = mass / m.volume;
  if (part.kind == "box" || part.kind == "ellipsoid")
    return {mass, part.center_m, tensor((density * m.square).asDiagonal())};
  return {mass, (part.from_m + part.to_m) / 2,
          tensor(about_axis(part.to_m - part.from_m, density * m.square.x(), density * m.square.z()))};
}

double squared_radius_of_gyration(const BladeOptions& blade) {
  validate_stations(blade);
  const Stations stations(blade);
  constexpr int samples = 2000;
  double mass = 0, moment = 0;
  for (int i = 0; i < samples; ++i) {
    const double r = stations.root + (1 - stations.root) * (i + 0.5) / samples, line = std::pow(stations.chord(r), 2);
    mass += line;
    moment += line * r * r;
  }
  return moment / mass * blade.radius_m * blade.radius_m;
}

MassProperties mass_of(const RotorOptions& rotor) {
  if (rotor.mass_kg == 0) return {};
  const double axial = rotor.mass_kg * squared_radius_of_gyration(rotor.blade);
  return {rotor.mass_kg, rotor.center_m, about_axis(rotor.axis, axial / 2, axial)};
}

MassProperties aircraft_mass(const AirframeOptions& airframe, const std::vector<RotorOptions>& rotors) {
  std::vector<MassProperties> bodies;
  for (const PartOptions& part : all_parts(airframe)) bodies.push_back(mass_of(part));
  for (const RotorOptions& rotor : rotors) bodies.push_back(mass_of(rotor));
  return combined(bodies);
}

}  // namespace windhover::geometry
