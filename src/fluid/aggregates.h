// Cells joined into aggregates, the unknowns of a coarser level: pairs along the strongest coupling, again and again
// (pairwise aggregation: Notay, Electron. Trans. Numer. Anal. 37 (2010) 123), so that cells as flat as those of a blade are joined
// across their large faces first.
#pragma once
#include <vector>

namespace windhover::fluid {

/// Neighbours of node i: neighbour[start[i]] to neighbour[start[i + 1] - 1], with the size of their coupling, which is
/// symmetric. A node is not its own neighbour.
struct CouplingGraph {
  std::vector<int> start{0}, neighbour;
  std::vector<double> strength;
  int nodes() const { return static_cast<int>(start.size()) - 1; }
};

/// The aggregate of each node, numbered from 0: up to 2^passes nodes each, more where a node is left over.
std::vector<int> aggregate(CouplingGraph graph, int passes);

}  // namespace windhover::fluid
