// Assembly of the first-order Jacobian, the matrix the preconditioners are made from.
#include <algorithm>

#include "fluid/euler.h"

namespace windhover::fluid {

using mesh::FaceBlock;
using mesh::Index;

namespace {

/// The blocks of eight faces, each as 25 contiguous numbers (column-major, as BAIJ stores them).
template <class Number>
struct alignas(64) LaneBlocks {
  Number block[mesh::kLanes][32];

  explicit LaneBlocks(const BlockPackOf<Number>& packs) {
    using P = PackOf<Number>;
    for (int part = 0; part < 4; ++part) {
      P columns[8], rows[8];
      for (int k = 0; k < 8; ++k) columns[k] = 8 * part + k < int(packs.size()) ? packs[8 * part + k] : P(0.0);
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
  for_each_interface(frames, whole_, [&](FaceInput in, const FaceBlock* blocks, int n) {
    BlockPack side;
    in.damping = damping;
    for (const FaceBlock* b = blocks; b < blocks + n; ++b) {
      for (int s = 0; s < 2; ++s) {
        model_.flux->jacobian(in, *b, s, side);
        const LaneBlocks lanes(side);
        for (int i = 0; i < b->count; ++i)
          if (const Index c = b->cell[s][i]; c < mesh_.n_owned)
            jacobian.add_diagonal(c, lanes.block[i], s == 0 ? scale : -scale);
      }
    }
  });
  for_each_zone(frames, whole_, [&](FaceInput in, const FaceBlock* blocks, int n) {
    BlockPack side;
    in.damping = damping;
    for (const FaceBlock* b = blocks; b < blocks + n; ++b) {
      const size_t first = size_t(b - mesh_.faces.data()) * mesh::kLanes;
      const auto cells = [b](int i) { return BlockJacobian::Cells{b->cell[0][i], b->cell[1][i]}; };
      for (int i = 0; i < b->count; ++i) jacobian.prefetch_face(first + i, cells(i));
      for (int s = 0; s < 2; ++s) {
        model_.flux->jacobian(in, *b, s, side);
        const LaneBlocks lanes(side);
        for (int i = 0; i < b->count; ++i) jacobian.add_face(first + i, cells(i), s, lanes.block[i], scale);
      }
    }
  });
  for_each_patch(frames, whole_, [&](const FaceInput& in, BoundaryKind kind, const FaceBlock* blocks, int n, int) {
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
  typedef Eigen::Matrix<float, kVariables, kVariables> Block;
  load_cells(q, frames);
  round_state();
  result.clear();
  const auto& interfaces = sliding_.faces(frames);
  const auto& singles = sliding_.faces<float>(frames);
  for (size_t i = 0; i < interfaces.size(); ++i) {
    const FaceInput in = face_input(frames[sliding_.frame_zone(i)]);
    Block back[2] = {Block::Identity(), Block::Identity()}, forth[2] = {Block::Identity(), Block::Identity()};
    for (int s = 0; s < 2 && !turn.none(); ++s) {
      back[s].block<3, 3>(1, 1) = turn.back(sliding_.zones(i)[s]).cast<float>();
      forth[s].block<3, 3>(1, 1) = turn.forth(sliding_.zones(i)[s]).cast<float>();
    }
    BlockPackOf<float> side;
    for (size_t block = 0; block < interfaces[i].size(); ++block)
      for (int column = 0; column < 2; ++column) {
        const FaceBlock& b = interfaces[i][block];
        const int row = 1 - column;
        const auto is_own = [&](int c) { return c < mesh_.n_owned; };
        if (std::none_of(b.cell[row], b.cell[row] + b.count, is_own)) continue;
        model_.flux->jacobian_single(in, singles[i][block], column, side);
        const LaneBlocks lanes(side);
        const Block to = static_cast<float>(row == 0 ? scale : -scale) * back[row];
        for (int k = 0; k < b.count; ++k) {
          if (!is_own(b.cell[row][k])) continue;
          InterfaceBlock& entry = result.emplace_back(b.cell[row][k], b.cell[column][k]);
          Block::Map(entry.block) = to * Block::Map(lanes.block[k]) * forth[column];
        }
      }
  }
}

}  // namespace windhover::fluid
