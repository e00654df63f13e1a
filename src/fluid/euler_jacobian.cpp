// Assembly of the first-order Jacobian, the matrix the preconditioners are made from.
#include "fluid/euler.h"

namespace windhover::fluid {

using mesh::FaceBlock;
using mesh::Index;

namespace {

/// The blocks of eight faces, each as 25 contiguous numbers (column-major, as BAIJ stores them).
struct alignas(64) LaneBlocks {
  double block[mesh::kLanes][32];

  explicit LaneBlocks(const BlockPack& packs) {
    for (int part = 0; part < 4; ++part) {
      Pack columns[8], rows[8];
      for (int k = 0; k < 8; ++k) columns[k] = 8 * part + k < int(packs.size()) ? packs[8 * part + k] : Pack(0.0);
      transpose(columns, rows);
      for (int i = 0; i < 8; ++i) rows[i].store(&block[i][8 * part]);
    }
  }
};

}  // namespace

void EulerOperator::first_order_jacobian(Vec q, const Frames& frames, double scale, double mass_scale,
                                         BlockJacobian& jacobian, double damping) {
  load_cells(q, frames);
  jacobian.begin();
  // across an interface only the cells' own blocks: the neighbours change from step to step
  for_each_interface(frames, [&](FaceInput in, const FaceBlock* blocks, int n) {
    BlockPack sides[2];
    in.damping = damping;
    for (const FaceBlock* b = blocks; b < blocks + n; ++b) {
      model_.flux->jacobian(in, *b, sides);
      for (int s = 0; s < 2; ++s) {
        const LaneBlocks lanes(sides[s]);
        for (int i = 0; i < b->count; ++i)
          if (const Index c = b->cell[s][i]; c < mesh_.n_owned)
            jacobian.add_diagonal(c, lanes.block[i], s == 0 ? scale : -scale);
      }
    }
  });
  for_each_zone(frames, [&](FaceInput in, const FaceBlock* blocks, int n) {
    BlockPack sides[2];
    in.damping = damping;
    for (const FaceBlock* b = blocks; b < blocks + n; ++b) {
      const size_t first = size_t(b - mesh_.faces.data()) * mesh::kLanes;
      for (int i = 0; i < b->count; ++i) jacobian.prefetch_face(first + i);
      model_.flux->jacobian(in, *b, sides);
      for (int s = 0; s < 2; ++s) {
        const LaneBlocks lanes(sides[s]);
        for (int i = 0; i < b->count; ++i) jacobian.add_face(first + i, s, lanes.block[i], scale);
      }
    }
  });
  for_each_patch(frames, [&](const FaceInput& in, BoundaryKind kind, const FaceBlock* blocks, int n, int) {
    BlockPack side;
    for (const FaceBlock* b = blocks; b < blocks + n; ++b) {
      kBoundaryKernels.jacobian(in, kind, *b, side);
      const LaneBlocks lanes(side);
      for (int i = 0; i < b->count; ++i) jacobian.add_diagonal(b->cell[0][i], lanes.block[i], scale);
    }
  });
  for (Index c = 0; c < mesh_.n_owned; ++c) jacobian.add_identity(c, mass_scale * mesh_.volume[c]);
  jacobian.finish();
}

void EulerOperator::interface_jacobian(Vec q, const Frames& frames, double scale, const ZoneTurn& turn,
                                       std::vector<InterfaceBlock>& result) {
  typedef Eigen::Matrix<double, kVariables, kVariables> Block;
  load_cells(q, frames);
  result.clear();
  const auto& interfaces = sliding_.faces(frames);
  for (size_t i = 0; i < interfaces.size(); ++i) {
    const FaceInput in = face_input(frames[sliding_.frame_zone(i)]);
    Block back[2] = {Block::Identity(), Block::Identity()}, forth[2] = {Block::Identity(), Block::Identity()};
    for (int s = 0; s < 2 && !turn.none(); ++s) {
      back[s].block<3, 3>(1, 1) = turn.back(sliding_.zones(i)[s]);
      forth[s].block<3, 3>(1, 1) = turn.forth(sliding_.zones(i)[s]);
    }
    BlockPack sides[2];
    for (const FaceBlock& b : interfaces[i].blocks) {
      model_.flux->jacobian(in, b, sides);
      for (int column = 0; column < 2; ++column) {
        const int row = 1 - column;
        const LaneBlocks lanes(sides[column]);
        for (int k = 0; k < b.count; ++k) {
          if (b.cell[row][k] >= mesh_.n_owned) continue;
          const Block block = (row == 0 ? scale : -scale) * back[row] * Block::Map(lanes.block[k]) * forth[column];
          result.push_back({b.cell[row][k], b.cell[column][k], block.cast<float>()});
        }
      }
    }
  }
}

}  // namespace windhover::fluid
