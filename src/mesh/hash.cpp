#include <cstring>

#include "mesh/cell_shape.h"
#include "mesh/file_mesh.h"

namespace windhover::mesh {
namespace {

/// FNV-1a, eight bytes at a time.
class Fnv {
 public:
  void add(std::uint64_t word) { state_ = (state_ ^ word) * 0x100000001b3ULL; }
  void add(double number) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &number, sizeof bits);
    add(bits);
  }
  std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 0xcbf29ce484222325ULL;
};

}  // namespace

std::uint64_t hash_of(const FileMesh& mesh) {
  Fnv hash;
  for (const FileCell& cell : mesh.cells) {
    hash.add(static_cast<std::uint64_t>(cell.type));
    hash.add(static_cast<std::uint64_t>(cell.zone));
    for (int i = 0; i < point_count(cell.type); ++i) {
      hash.add(static_cast<std::uint64_t>(cell.corners[i].node));
      for (int d = 0; d < 3; ++d) hash.add(cell.corners[i].position[d]);
    }
  }
  return hash.value();
}

}  // namespace windhover::mesh
