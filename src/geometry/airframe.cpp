#include "geometry/airframe.h"

#include <algorithm>

#include "base/errors.h"

namespace windhover::geometry {
namespace {

template <class... Args>
[[noreturn]] void refuse(const PartOptions& part, fmt::format_string<Args...> format, Args&&... args) {
  throw UserError("airframe: part \"{}\": {}", part.name, fmt::format(format, std::forward<Args>(args)...));
}

bool is_along_axis(const PartOptions& part) { return part.kind == "cylinder" || part.kind == "capsule"; }

PartOptions image(PartOptions part, int axis) {
  for (Vec3* point : {&part.center_m, &part.from_m, &part.to_m}) (*point)[axis] *= -1;
  return part;
}

void validate_size(const PartOptions& part) {
  if (is_along_axis(part)) {
    if (part.radius_m == 0) refuse(part, "radius_m is needed");
    if (part.from_m == part.to_m) refuse(part, "from_m and to_m are the same point");
  } else if (const Vec3& size = part.kind == "box" ? part.size_m : part.radii_m; size.minCoeff() == 0) {
    refuse(part, "{} = [{}, {}, {}]: must be > 0", part.kind == "box" ? "size_m" : "radii_m", size.x(), size.y(),
           size.z());
  }
  const double half =
      part.kind == "box" ? part.size_m.minCoeff() / 2 : std::min(part.radius_m, (part.to_m - part.from_m).norm() / 2);
  if (part.rounding_m > 0.95 * half)
    refuse(part, "rounding_m = {}: must be at most {:.4g}, 95 % of its smallest half width", part.rounding_m,
           0.95 * half);
}

}  // namespace

void complete(AirframeOptions& airframe, const std::filesystem::path& folder) {
  if (!airframe.step.empty()) airframe.step = (folder / airframe.step).lexically_normal();
}

void validate(const AirframeOptions& airframe) {
  if (!airframe.step.empty() && !std::filesystem::is_regular_file(airframe.step))
    throw UserError("airframe: {}: cannot read this STEP file", airframe.step);
  for (const PartOptions& part : airframe.part) {
    validate_size(part);
    if (part.mass_kg > 0 && part.density_kg_m3 > 0)
      refuse(part, "give either mass_kg = {} or density_kg_m3 = {}, not both", part.mass_kg, part.density_kg_m3);
    for (const int axis : {0, 2}) {
      const Vec3 middle = is_along_axis(part) ? Vec3((part.from_m + part.to_m) / 2) : part.center_m;
      if (part.mirror.find("x?z"[axis]) != std::string::npos && middle[axis] == 0)
        refuse(part, "mirror = \"{}\": its centre lies in the plane {} = 0", part.mirror, "x?z"[axis]);
    }
  }
}

std::vector<PartOptions> all_parts(const AirframeOptions& airframe) {
  std::vector<PartOptions> parts;
  for (const PartOptions& part : airframe.part) {
    const bool x = part.mirror.starts_with('x'), z = part.mirror.ends_with('z');
    parts.push_back(part);
    if (x) parts.push_back(image(part, 0));
    if (z) parts.push_back(image(part, 2));
    if (x && z) parts.push_back(image(image(part, 0), 2));
  }
  return parts;
}

}  // namespace windhover::geometry
