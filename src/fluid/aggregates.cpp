#include "fluid/aggregates.h"

#include <algorithm>

namespace windhover::fluid {
namespace {

/// The neighbour with the strongest coupling of those that `wanted` lets through; -1: none.
template <class Wanted>
int strongest(const CouplingGraph& graph, int node, Wanted&& wanted) {
  int best = -1;
  double strength = 0;
  for (int at = graph.start[node]; at < graph.start[node + 1]; ++at)
    if (graph.strength[at] > strength && wanted(graph.neighbour[at])) {
      best = graph.neighbour[at];
      strength = graph.strength[at];
    }
  return best;
}

/// Pairs; who is left over joins the pair of its strongest neighbour.
std::vector<int> pairs(const CouplingGraph& graph) {
  std::vector<int> group(graph.nodes(), -1), left_over;
  int groups = 0;
  for (int i = 0; i < graph.nodes(); ++i) {
    if (group[i] >= 0) continue;
    const int partner = strongest(graph, i, [&](int j) { return group[j] < 0; });
    if (partner < 0) {
      left_over.push_back(i);
      continue;
    }
    group[i] = group[partner] = groups++;
  }
  for (const int i : left_over) {
    const int host = strongest(graph, i, [&](int j) { return group[j] >= 0; });
    group[i] = host >= 0 ? group[host] : groups++;
  }
  return group;
}

int count(const std::vector<int>& group) { return group.empty() ? 0 : *std::max_element(group.begin(), group.end()) + 1; }

CouplingGraph collapse(const CouplingGraph& graph, const std::vector<int>& group) {
  std::vector<std::vector<int>> members(count(group));
  for (int i = 0; i < graph.nodes(); ++i) members[group[i]].push_back(i);
  CouplingGraph coarse;
  std::vector<int> place(members.size(), -1);
  for (int row = 0; row < static_cast<int>(members.size()); ++row) {
    const int begin = coarse.start.back();
    for (const int i : members[row])
      for (int at = graph.start[i]; at < graph.start[i + 1]; ++at) {
        const int column = group[graph.neighbour[at]];
        if (column == row) continue;
        if (place[column] < begin) {
          place[column] = static_cast<int>(coarse.neighbour.size());
          coarse.neighbour.push_back(column);
          coarse.strength.push_back(0);
        }
        coarse.strength[place[column]] += graph.strength[at];
      }
    coarse.start.push_back(static_cast<int>(coarse.neighbour.size()));
  }
  return coarse;
}

}  // namespace

std::vector<int> aggregate(CouplingGraph graph, int passes) {
  std::vector<int> group(graph.nodes());
  for (int i = 0; i < graph.nodes(); ++i) group[i] = i;
  for (int pass = 0; pass < passes; ++pass) {
    const std::vector<int> joined = pairs(graph);
    for (int& g : group) g = joined[g];
    graph = collapse(graph, joined);
  }
  return group;
}

}  // namespace windhover::fluid
