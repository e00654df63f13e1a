#include "mesh/sliding/surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/errors.h"

namespace windhover::mesh {

RevolutionSurface::RevolutionSurface(const SlidingSurface& description)
    : origin_(description.point),
      is_sphere_(description.shape == SlidingSurface::Shape::sphere),
      radius_(description.radius),
      z0_(description.z0),
      z1_(description.z1) {
  if (!(radius_ > 0)) throw UserError("sliding interface: radius {} is not above 0", radius_);
  if (!(description.axis.norm() > 0)) throw UserError("sliding interface: the axis has no direction");
  if (!is_sphere_ && !(z1_ > z0_))
    throw UserError("sliding interface: the cylinder ends at {}, before its begin {}", z1_, z0_);
  axes_.col(2) = description.axis.normalized();
  axes_.col(0) = axes_.col(2).unitOrthogonal();
  axes_.col(1) = axes_.col(2).cross(axes_.col(0));
}

double RevolutionSurface::area(Part part) const {
  using std::numbers::pi;
  switch (part) {
    case Part::wall: return 2 * pi * radius_ * height();
    case Part::bottom:
    case Part::top: return pi * radius_ * radius_;
    case Part::sphere: return 4 * pi * radius_ * radius_;
  }
  return 0;
}

double RevolutionSurface::reach() const {
  const double along = is_sphere_ ? 0 : std::max(std::abs(z0_), std::abs(z1_));
  return origin_.norm() + radius_ + along;
}

bool RevolutionSurface::contains(const Vec3& local) const {
  if (is_sphere_) return local.norm() <= radius_;
  return std::hypot(local.x(), local.y()) <= radius_ && local.z() >= z0_ && local.z() <= z1_;
}

Place RevolutionSurface::place(const Vec3& local) const {
  if (is_sphere_) {
    const double r = local.norm();
    return {r > 0 ? Vec3(local * (radius_ / r)) : Vec3(radius_ * Vec3::UnitZ()), bit(Part::sphere),
            std::abs(r - radius_)};
  }
  const double rho = std::hypot(local.x(), local.y());
  const double to_wall = std::abs(rho - radius_), to_bottom = std::abs(local.z() - z0_),
               to_top = std::abs(local.z() - z1_);
  const auto beyond = [](double x) { return std::max(x, 0.0); };
  const double wall = std::hypot(to_wall, beyond(z0_ - local.z()) + beyond(local.z() - z1_));
  const double disc = std::hypot(std::min(to_bottom, to_top), beyond(rho - radius_));
  const Part nearer = to_bottom < to_top ? Part::bottom : Part::top;
  Place place{local, 0, std::min(wall, disc)};
  const double reach = std::max(place.distance, tolerance());
  if (wall <= reach) place.parts |= bit(Part::wall);
  if (disc <= reach) place.parts |= bit(nearer);
  if (disc <= reach) place.position.z() = this->disc(nearer);
  if (wall <= reach && rho > 0) place.position.head<2>() *= radius_ / rho;
  return place;
}

}  // namespace windhover::mesh
