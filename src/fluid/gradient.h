// Gradients of cell values that are exact for linear fields on any mesh.
#pragma once
#include <optional>
#include <tuple>
#include <vector>

#include "fluid/cell_rows.h"
#include "mesh/mesh.h"

namespace windhover::fluid {

/// Inverse-distance weighted least squares over all cells that share a node.
class LeastSquares {
 public:
  /// For all cells that need gradients, or for some of them.
  explicit LeastSquares(const mesh::Mesh& mesh);
  LeastSquares(const mesh::Mesh& mesh, std::vector<int> cells);

  /// cells: [n_cells] rows, gradients: [n_gradient], in zone axes. A linear map: also takes derivatives of cells. Number is
  /// double or float.
  template <class Number>
  void apply(const RowOf<Number>* cells, GradientRowOf<Number>* gradients) const;

 private:
  std::vector<int> cell_;
  std::vector<int> start_, neighbour_;
  std::vector<std::array<double, 3>> coefficient_;
};

/// Green–Gauss from node values. A node value is the inverse-distance weighted mean of the cells around the node
/// (Frink 1994), a cell's gradient sums face integrals of the nodes' linear interpolant. Applied to x, y, z that gives
/// a matrix G instead of the identity; multiplying the cell's coefficients by G⁻¹ once, at set-up, makes every linear
/// field exact at no cost later. (Where the mesh has one cell across, G has no inverse across: the pseudo-inverse
/// leaves that derivative zero.) The few cells with a nearly singular G, mostly with all nodes on a boundary, would
/// amplify noise: they get least squares.
class GreenGauss {
 public:
  explicit GreenGauss(const mesh::Mesh& mesh);
  /// As LeastSquares.
  template <class Number>
  void apply(const RowOf<Number>* cells, GradientRowOf<Number>* gradients) const {
    begin(cells);
    end(cells, gradients);
  }
  /// The same in two parts: the first needs this rank's own cells alone, and may come while the others are under way.
  template <class Number>
  void begin(const RowOf<Number>* cells) const;
  template <class Number>
  void end(const RowOf<Number>* cells, GradientRowOf<Number>* gradients) const;

  /// Of some cells; nodes: nodes_of() them.
  template <class Number>
  void apply(const RowOf<Number>* cells, GradientRowOf<Number>* gradients, const std::vector<int>& some,
             const std::vector<int>& nodes) const;
  std::vector<int> nodes_of(const std::vector<int>& cells) const;

 private:
  template <class Number>
  void average(int first, int last, const RowOf<Number>* cells) const;
  template <class Number>
  void differentiate(int cell, GradientRowOf<Number>* gradients) const;

  int n_inner_;                  // nodes of own cells alone, which come first
  std::vector<int> node_start_;  // of each node used, into the next two
  std::vector<int> node_cell_;
  std::vector<double> node_weight_;
  std::vector<int> cell_start_;  // of each cell with gradient, into the next
  std::vector<int> cell_node_;
  std::vector<std::array<double, 3>> coefficient_;  // of differences from a cell's first node: one less than nodes
  template <class Number>
  using NodeRows = std::vector<RowOf<Number>>;
  mutable std::tuple<NodeRows<double>, NodeRows<float>> node_rows_;  // each from the first time it is needed
  std::optional<LeastSquares> exceptions_;
};

}  // namespace windhover::fluid
