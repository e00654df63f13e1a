// The airfoils along a blade.
#pragma once
#include <vector>

#include "geometry/airfoil.h"
#include "geometry/rotor_options.h"

namespace windhover::geometry {

/// UserError: an airfoil and sections, sections off the blade or not from the root outwards, what make_airfoil refuses.
void validate_sections(const BladeOptions& blade);

/// Linear in r/R between the sections, constant within the first and beyond the last.
class Sections {
 public:
  explicit Sections(const BladeOptions& blade);
  Airfoil airfoil(double r_over_R) const;

 private:
  std::vector<double> r_over_R_;
  std::vector<Airfoil> airfoil_;
};

}  // namespace windhover::geometry
