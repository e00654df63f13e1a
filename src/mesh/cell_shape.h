// The four cell shapes: their faces as lists of their own points.
#pragma once
#include <array>
#include <span>

#include "mesh/mesh.h"

namespace windhover::mesh {

inline constexpr int point_count(CellType type) { return static_cast<int>(type); }

/// One face of a shape: 3 or 4 points in the order that makes its normal point outwards.
struct ShapeFace {
  int n;
  std::array<int, 4> point;
};

/// Points are numbered as VTK does: a hexahedron's first base turns towards its second one, a prism's away from it.
inline std::span<const ShapeFace> faces_of(CellType type) {
  static constexpr ShapeFace tetrahedron[] = {{3, {0, 2, 1, -1}}, {3, {0, 1, 3, -1}}, {3, {1, 2, 3, -1}}, {3, {2, 0, 3, -1}}};
  static constexpr ShapeFace pyramid[] = {
      {4, {0, 3, 2, 1}}, {3, {0, 1, 4, -1}}, {3, {1, 2, 4, -1}}, {3, {2, 3, 4, -1}}, {3, {3, 0, 4, -1}}};
  static constexpr ShapeFace prism[] = {
      {3, {0, 1, 2, -1}}, {3, {3, 5, 4, -1}}, {4, {0, 3, 4, 1}}, {4, {1, 4, 5, 2}}, {4, {2, 5, 3, 0}}};
  static constexpr ShapeFace hexahedron[] = {{4, {0, 3, 2, 1}}, {4, {4, 5, 6, 7}}, {4, {0, 1, 5, 4}},
                                             {4, {1, 2, 6, 5}}, {4, {2, 3, 7, 6}}, {4, {3, 0, 4, 7}}};
  switch (type) {
    case CellType::tetrahedron: return tetrahedron;
    case CellType::pyramid: return pyramid;
    case CellType::prism: return prism;
    case CellType::hexahedron: return hexahedron;
  }
  return {};
}

}  // namespace windhover::mesh
