// The blades of a rotor: their triangulated surfaces, and the sizes of cells beside them.
#pragma once
#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "geometry/airfoil.h"
#include "geometry/grading.h"
#include "geometry/rotor_options.h"
#include "geometry/sections.h"
#include "geometry/stations.h"

namespace windhover::geometry {

/// Closed, normals outwards.
struct TriangleSurface {
  std::vector<Vec3> points;
  std::vector<std::array<int, 3>> triangles;
};

/// Columns: the direction of the first blade at angle 0, the one a quarter turn on, the axis.
Eigen::Matrix3d rotor_axes(const RotorOptions& rotor);

/// A section of a blade: points of it are quarter_chord + chord ((x − ¼) back + y up) with x, y in chords.
struct BladeSection {
  Vec3 quarter_chord, back, up;
  double chord;
  Vec3 at(const Vec2& p) const { return quarter_chord + chord * ((p.x() - 0.25) * back + p.y() * up); }
};

class Blades {
 public:
  Blades(const RotorOptions& rotor, double refine);

  /// Rows of sections, closed at root and tip by strips of points across the thickness.
  TriangleSurface surface(int blade) const;

  /// The section at a radius along the pitch axis, at the rotor's angle at the start; metres.
  BladeSection section(int blade, double radius) const;

  /// Wanted size at a point at refine = 1: the geometric mean of those along chord and span on the nearest blade, growing with the distance.
  double size(const Vec3& point) const;

 private:
  BladeSection local_section(double radius) const;  ///< in the blade's frame: x towards the tip, z above the blade's plane
  double coarsening(double chord) const;  ///< keeps edges along short chords from falling below smallest_m: at most 1
  Airfoil points(double radius) const;    ///< from leading to trailing edge, in chords
  int cells_across(const Airfoil& points, int point) const;
  TriangleSurface local_surface() const;
  Eigen::Isometry3d pose(int blade) const;  ///< from the blade's frame

  RotorOptions rotor_;
  double refine_;
  Stations stations_;
  Sections sections_;
  Grading chordwise_, spanwise_;  ///< the first along x in chords
  double first_radius_, last_radius_;
  int across_;  ///< cells across the thickness at root and tip, at most
  std::vector<Eigen::Isometry3d> to_blade_;
};

}  // namespace windhover::geometry
