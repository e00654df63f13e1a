// What a case says of an airframe: its parts or a STEP file, its masses and the sizes of its mesh.
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

namespace windhover::geometry {

using Vec3 = Eigen::Vector3d;

/// One solid with its mass; the keys of the other kinds are unused.
struct PartOptions {
  std::string name = "part", kind = "box";
  Vec3 center_m = Vec3::Zero(), size_m = Vec3::Zero(), radii_m = Vec3::Zero();
  Vec3 from_m = Vec3::Zero(), to_m = Vec3::Zero();
  double radius_m = 0, rounding_m = 0;
  std::string mirror = "none";
  double mass_kg = 0, density_kg_m3 = 0;  ///< at most one of them
};

struct AirframeOptions {
  std::string step;  ///< file, or empty; after complete(): absolute
  std::vector<PartOptions> part;
  double size_m = 0, min_size_m = 0;  ///< at mesh.refine = 1
  double cells_per_turn = 10, growth = 0.3;

  bool is_given() const { return !step.empty() || !part.empty(); }
};

}  // namespace windhover::geometry
