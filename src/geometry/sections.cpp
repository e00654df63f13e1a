#include "geometry/sections.h"

#include <algorithm>

#include "base/errors.h"

namespace windhover::geometry {

void validate_sections(const BladeOptions& blade) {
  if (!blade.airfoil.empty() && !blade.section.empty())
    throw UserError("give either airfoil = \"{}\" or [[section]], not both", blade.airfoil);
  if (blade.section.empty()) make_airfoil(blade.airfoil, blade.trailing_edge_thickness);
  for (size_t i = 0; i < blade.section.size(); ++i) {
    const double r = blade.section[i].r_over_R, root = blade.r_over_R.front();
    if (r < root || r > 1) throw UserError("section[{}].r_over_R = {}: must be on the blade, from {} to 1", i, r, root);
    if (i > 0 && r <= blade.section[i - 1].r_over_R)
      throw UserError("section[{}].r_over_R = {}: must be greater than {} before it", i, r,
                      blade.section[i - 1].r_over_R);
    if (blade.section[i].airfoil.empty()) throw UserError("section[{}].airfoil is needed", i);
    try {
      make_airfoil(blade.section[i].airfoil, blade.trailing_edge_thickness);
    } catch (const UserError& error) {
      throw UserError("section[{}]: {}", i, error.what());
    }
  }
}

Sections::Sections(const BladeOptions& blade) {
  const auto add = [&](double r_over_R, const std::string& name) {
    r_over_R_.push_back(r_over_R);
    airfoil_.push_back(make_airfoil(name, blade.trailing_edge_thickness));
  };
  for (const SectionOptions& section : blade.section) add(section.r_over_R, section.airfoil);
  if (blade.section.empty()) add(1, blade.airfoil);
}

Airfoil Sections::airfoil(double r_over_R) const {
  const size_t i = std::upper_bound(r_over_R_.begin(), r_over_R_.end(), r_over_R) - r_over_R_.begin();
  if (i == 0) return airfoil_.front();
  if (i == r_over_R_.size()) return airfoil_.back();
  return blend(airfoil_[i - 1], airfoil_[i], (r_over_R - r_over_R_[i - 1]) / (r_over_R_[i] - r_over_R_[i - 1]));
}

}  // namespace windhover::geometry
