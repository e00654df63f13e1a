// Faces in blocks of eight: the unit in which fluxes are computed (one vector register wide).
#pragma once
#include <algorithm>
#include <cstdint>
#include <type_traits>

namespace windhover::mesh {

inline constexpr int kLanes = 8;

/// Up to eight faces of one zone. All geometry is constant and in the zone's own frame, in units of the
/// reference length; the normal points from cell[0] to cell[1] (on a boundary: out of cell[0], and cell[1] == cell[0]).
/// Lanes beyond `count` are padding: area and moment zero, arms zero, cells a valid copy of lane 0's.
struct alignas(64) FaceBlock {
  double area[3][kLanes];      ///< A = ∫ n dA
  double moment[3][kLanes];    ///< M = ∫ r × n dA about the zone's origin
  double arm[kLanes][2][3];    ///< face centroid minus the centroid of cell[side]
  int cell[2][kLanes];         ///< local cells
  int count = 0;
  std::int8_t side[kLanes];    ///< which face of cell[0] this is (faces_of its type)
};

/// What products of floats read of a block, half as long.
struct alignas(64) SingleFaceBlock {
  float area[3][kLanes], moment[3][kLanes], arm[kLanes][2][3];
  int cell[2][kLanes];

  SingleFaceBlock(const FaceBlock& b) {
    std::copy_n(b.area[0], 3 * kLanes, area[0]);
    std::copy_n(b.moment[0], 3 * kLanes, moment[0]);
    std::copy_n(b.arm[0][0], 6 * kLanes, arm[0][0]);
    std::copy_n(b.cell[0], 2 * kLanes, cell[0]);
  }
};

template <class Number>
using FaceBlockOf = std::conditional_t<std::is_same_v<Number, float>, SingleFaceBlock, FaceBlock>;

}  // namespace windhover::mesh
