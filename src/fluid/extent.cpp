#include "fluid/extent.h"

#include <algorithm>

namespace windhover::fluid {

using mesh::FaceBlock;
using mesh::Index;

namespace {

Index lower_cell(const FaceBlock& b, int lane) { return std::min(b.cell[0][lane], b.cell[1][lane]); }

}  // namespace

std::vector<Index> own_cells_within(const mesh::Mesh& mesh, const std::vector<Index>& from, int layers) {
  std::vector<char> within(mesh.n_cells);
  for (const Index c : from) within[c] = true;
  for (int k = 0; k < layers; ++k) {
    const std::vector<char> nearer = within;
    for (const FaceBlock& b : mesh.faces)
      for (int i = 0; i < b.count; ++i)
        if (nearer[b.cell[0][i]] || nearer[b.cell[1][i]]) within[b.cell[0][i]] = within[b.cell[1][i]] = true;
  }
  std::vector<Index> cells;
  for (Index c = 0; c < mesh.n_owned; ++c)
    if (within[c]) cells.push_back(c);
  return cells;
}

Extent Extent::whole(const mesh::Mesh& mesh) {
  Extent e;
  e.cells.resize(mesh.zones.size());
  for (Index c = 0; c < mesh.n_owned; ++c) {
    mesh::Range& zone = e.cells[mesh.cell_zone[c]];
    if (zone.size() == 0) zone.begin = c;
    zone.end = c + 1;
  }
  for (const mesh::Zone& zone : mesh.zones) e.faces.push_back(zone.faces);
  for (const mesh::Patch& patch : mesh.patches) e.patch_blocks.push_back(static_cast<int>(patch.blocks.size()));
  return e;
}

Extent Extent::near(const mesh::Mesh& mesh, const std::vector<Index>& from, int layers) {
  Extent e = whole(mesh);
  for (mesh::Range& zone : e.cells) zone.end = zone.begin;
  for (const Index c : own_cells_within(mesh, from, layers)) e.cells[mesh.cell_zone[c]].end = c + 1;
  const auto end_of = [&](Index cell) { return e.cells[mesh.cell_zone[cell]].end; };
  const auto is_near = [&](const FaceBlock& b) { return lower_cell(b, 0) < end_of(lower_cell(b, 0)); };
  std::vector<int> others;
  for (mesh::Range& zone : e.faces) {
    // sorted by their lower cells
    zone.end = static_cast<Index>(std::partition_point(mesh.faces.begin() + zone.begin, mesh.faces.begin() + zone.end, is_near) -
                                  mesh.faces.begin());
    for (Index i = zone.begin; i < zone.end; ++i)
      for (const auto& side : mesh.faces[i].cell)
        for (const Index c : side)
          if (c >= mesh.n_owned)
            others.push_back(c);
          else if (c >= end_of(c))
            e.touched.push_back(c);
  }
  for (size_t p = 0; p < mesh.patches.size(); ++p) {
    const auto& blocks = mesh.patches[p].blocks;
    e.patch_blocks[p] = static_cast<int>(std::partition_point(blocks.begin(), blocks.end(), is_near) - blocks.begin());
    for (int i = 0; i < e.patch_blocks[p]; ++i)
      for (const Index c : blocks[i].cell[0])
        if (c >= end_of(c)) e.touched.push_back(c);
  }
  const auto sort = [](auto& list) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  };
  sort(e.touched);
  sort(others);
  for (const mesh::Range& zone : e.cells)
    for (Index c = zone.begin; c < zone.end; ++c) e.gradients.push_back(c);
  e.gradients.insert(e.gradients.end(), others.begin(), others.end());
  return e;
}

}  // namespace windhover::fluid
