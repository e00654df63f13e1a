// The surface of revolution between a zone and its parent.
#pragma once
#include <Eigen/Geometry>

#include "mesh/motion.h"

namespace windhover::mesh {

/// A surface of revolution Γ at rest in the parent's frame, on which the zone inside turns: a sphere, or a cylinder's wall
/// and its two discs.
struct SlidingSurface {
  enum class Shape { cylinder, sphere };
  Shape shape = Shape::cylinder;
  Vec3 point = Vec3::Zero();  ///< on the axis; a sphere's centre
  Vec3 axis = Vec3::UnitZ();  ///< of any length
  double radius = 1;
  double z0 = 0, z1 = 1;  ///< cylinder: places of the discs along the axis, from the point
};

enum class Part { wall, bottom, top, sphere };

/// Where a node lies: the nearest point of Γ in Γ's axes, the parts that meet there (bits), how far it is away.
struct Place {
  Vec3 position = Vec3::Zero();
  unsigned parts = 0;
  double distance = 0;
};
constexpr unsigned bit(Part part) { return 1U << static_cast<unsigned>(part); }

/// Γ with its own axes: origin at its point, the third axis along its axis.
class RevolutionSurface {
 public:
  /// UserError: no radius, no axis, or discs in the wrong order.
  explicit RevolutionSurface(const SlidingSurface& description);

  Vec3 to_local(const Vec3& r) const { return axes_.transpose() * (r - origin_); }
  Vec3 to_parent(const Vec3& x) const { return origin_ + axes_ * x; }
  const Mat3& axes() const { return axes_; }
  const Vec3& origin() const { return origin_; }

  bool is_sphere() const { return is_sphere_; }
  double radius() const { return radius_; }
  double height() const { return z1_ - z0_; }
  double disc(Part part) const { return part == Part::bottom ? z0_ : z1_; }
  double area(Part part) const;
  /// Distance of Γ's farthest point from the parent's origin, or a little more.
  double reach() const;

  /// A node is on the rim when it is nearer to it than the tolerance.
  Place place(const Vec3& local) const;
  bool contains(const Vec3& local) const;
  double tolerance() const { return 1e-6 * radius_; }

 private:
  Mat3 axes_;
  Vec3 origin_;
  bool is_sphere_;
  double radius_, z0_, z1_;
};

}  // namespace windhover::mesh
