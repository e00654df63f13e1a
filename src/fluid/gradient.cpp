#include "fluid/gradient.h"

#include <Eigen/SVD>
#include <algorithm>
#include <map>
#include <numeric>

#include "mesh/cell_shape.h"
#include "mesh/motion.h"

namespace windhover::fluid {

using mesh::Index;
using mesh::Mat3;
using mesh::Mesh;
using mesh::Vec3;

namespace {

/// Inverse that leaves directions without information out (one cell across).
struct PseudoInverse {
  Mat3 matrix;
  double amplification;  ///< its norm
};
PseudoInverse pseudo_inverse(const Mat3& a) {
  Eigen::JacobiSVD<Mat3> svd(a, Eigen::ComputeFullU | Eigen::ComputeFullV);
  svd.setThreshold(1e-8);
  return {svd.solve(Mat3::Identity()), 1.0 / svd.singularValues()[svd.rank() - 1]};
}

/// Green–Gauss coefficients of a cell's points: gradient = Σ coefficient_j value_j. Faces are fans of triangles about the
/// mean of their points (as in the geometry of the faces), values linear on each triangle.
void green_gauss_coefficients(mesh::CellType type, const Vec3* points, double volume, Vec3* coefficient) {
  for (int j = 0; j < mesh::point_count(type); ++j) coefficient[j].setZero();
  for (const mesh::ShapeFace& face : mesh::faces_of(type)) {
    Vec3 apex = Vec3::Zero();
    for (int i = 0; i < face.n; ++i) apex += points[face.point[i]] / face.n;
    for (int i = 0; i < face.n; ++i) {
      const int a = face.point[i], b = face.point[(i + 1) % face.n];
      const Vec3 third = (points[a] - apex).cross(points[b] - apex) / (6.0 * volume);  // area / 3 of the triangle
      coefficient[a] += third;
      coefficient[b] += third;
      for (int k = 0; k < face.n; ++k) coefficient[face.point[k]] += third / face.n;
    }
  }
}

/// node → (cell, the cell's point for that node) for the nodes of cells that need gradients; nodes of own cells alone first.
struct NodeCells {
  int n_inner = 0;
  std::vector<int> start, cell, point;
  std::vector<int> used;  // mesh node → node here, or -1
};

NodeCells collect_node_cells(const Mesh& m) {
  NodeCells n;
  n.used.assign(m.n_nodes, -1);
  std::vector<char> outer(m.n_nodes, false);  // has other ranks' cells
  for (Index k = m.cell_point_start[m.n_owned]; k < m.cell_point_start[m.n_cells]; ++k)
    outer[m.point_node[m.cell_point[k]]] = true;
  int count = 0;
  for (const bool kind : {false, true}) {
    for (Index k = 0; k < m.cell_point_start[m.n_gradient]; ++k) {
      const Index node = m.point_node[m.cell_point[k]];
      if (n.used[node] < 0 && outer[node] == kind) n.used[node] = count++;
    }
    if (!kind) n.n_inner = count;
  }
  n.start.assign(count + 1, 0);
  const auto node_of = [&](Index k) { return n.used[m.point_node[m.cell_point[k]]]; };
  for (Index k = 0; k < m.cell_point_start[m.n_cells]; ++k)
    if (node_of(k) >= 0) ++n.start[node_of(k) + 1];
  for (int i = 0; i < count; ++i) n.start[i + 1] += n.start[i];
  n.cell.resize(n.start[count]);
  n.point.resize(n.start[count]);
  std::vector<int> fill(n.start.begin(), n.start.end() - 1);
  for (Index c = 0; c < m.n_cells; ++c)
    for (Index k = m.cell_point_start[c]; k < m.cell_point_start[c + 1]; ++k)
      if (const int node = node_of(k); node >= 0) {
        n.cell[fill[node]] = c;
        n.point[fill[node]++] = m.cell_point[k];
      }
  return n;
}

}  // namespace

GreenGauss::GreenGauss(const Mesh& m) {
  NodeCells nodes = collect_node_cells(m);
  const int n_nodes = static_cast<int>(nodes.start.size()) - 1;
  node_weight_.resize(nodes.cell.size());
  std::vector<Vec3> mean_shift(n_nodes, Vec3::Zero());  // weighted mean of cell centroids, from the node
  for (int i = 0; i < n_nodes; ++i) {
    double sum = 0;
    for (int k = nodes.start[i]; k < nodes.start[i + 1]; ++k) {
      const Vec3 d = m.centroid[nodes.cell[k]] - m.point[nodes.point[k]];
      sum += node_weight_[k] = 1.0 / d.norm();
      mean_shift[i] += node_weight_[k] * d;
    }
    mean_shift[i] /= sum;
    for (int k = nodes.start[i]; k < nodes.start[i + 1]; ++k) node_weight_[k] /= sum;
  }

  constexpr double kLargestAmplification = 4;  // of a regular cell: 1 to 2
  std::vector<int> ill_conditioned;
  cell_start_.push_back(0);
  for (Index c = 0; c < m.n_gradient; ++c) {
    const Index first = m.cell_point_start[c];
    const int n = mesh::point_count(m.type[c]);
    Vec3 points[8], coefficient[8];
    for (int j = 0; j < n; ++j) points[j] = m.point[m.cell_point[first + j]] - m.centroid[c];
    green_gauss_coefficients(m.type[c], points, m.volume[c], coefficient);
    Mat3 g = Mat3::Zero();
    for (int j = 0; j < n; ++j) {
      const int node = nodes.used[m.point_node[m.cell_point[first + j]]];
      g += coefficient[j] * (points[j] + mean_shift[node]).transpose();
    }
    const auto [correction, amplification] = pseudo_inverse(g);
    if (amplification > kLargestAmplification) ill_conditioned.push_back(c);
    for (int j = 0; j < n; ++j) {
      const Vec3 d = correction * coefficient[j];
      cell_node_.push_back(nodes.used[m.point_node[m.cell_point[first + j]]]);
      if (j > 0) coefficient_.push_back({d.x(), d.y(), d.z()});
    }
    cell_start_.push_back(static_cast<int>(cell_node_.size()));
  }
  n_inner_ = nodes.n_inner;
  node_start_ = std::move(nodes.start);
  node_cell_ = std::move(nodes.cell);
  if (!ill_conditioned.empty()) exceptions_.emplace(m, std::move(ill_conditioned));
}

/// Fills the rows of these nodes.
template <class Number>
void GreenGauss::average(int first, int last, const RowOf<Number>* cells) const {
  using P = PackOf<Number>;
  constexpr int kEntriesAhead = 64;  // asked for before they are needed
  const int last_entry = static_cast<int>(node_cell_.size()) - 1;
  auto& node_rows = std::get<NodeRows<Number>>(node_rows_);
  for (int i = first; i < last; ++i) {
    P sum(0.0);
    for (int k = node_start_[i]; k < node_start_[i + 1]; ++k) {
      __builtin_prefetch(&cells[node_cell_[std::min(k + kEntriesAhead, last_entry)]]);
      sum += node_weight_[k] * P::load(cells[node_cell_[k]].v);
    }
    sum.store(node_rows[i].v);
  }
}

template <class Number>
void GreenGauss::begin(const RowOf<Number>* cells) const {
  auto& node_rows = std::get<NodeRows<Number>>(node_rows_);
  node_rows.resize(node_start_.size() - 1);
  average(0, n_inner_, cells);
}

/// From the rows of its nodes.
template <class Number>
inline void GreenGauss::differentiate(int c, GradientRowOf<Number>* gradients) const {
  using P = PackOf<Number>;
  const auto& node_rows = std::get<NodeRows<Number>>(node_rows_);
  const P base = P::load(node_rows[cell_node_[cell_start_[c]]].v);
  P g[3] = {0.0, 0.0, 0.0};
  for (int k = cell_start_[c] + 1; k < cell_start_[c + 1]; ++k) {
    const P difference = P::load(node_rows[cell_node_[k]].v) - base;
    for (int d = 0; d < 3; ++d) g[d] += coefficient_[k - c - 1][d] * difference;
  }
  gradients[c].store(g);
}

template <class Number>
void GreenGauss::end(const RowOf<Number>* cells, GradientRowOf<Number>* gradients) const {
  average(n_inner_, static_cast<int>(node_start_.size()) - 1, cells);
  constexpr int kCellsAhead = 12;
  const int n_cells = static_cast<int>(cell_start_.size()) - 1;
  for (int c = 0; c < n_cells; ++c) {
    const int ahead = std::min(c + kCellsAhead, n_cells - 1);
    for (size_t k = 0; k < 16; k += 64 / sizeof(Number)) __builtin_prefetch(gradients[ahead].v + k, 1);
    for (int k = 0; k < 16; k += 8) __builtin_prefetch(coefficient_[cell_start_[ahead] - ahead].data() + k);
    differentiate(c, gradients);
  }
  if (exceptions_) exceptions_->apply(cells, gradients);
}

template <class Number>
void GreenGauss::apply(const RowOf<Number>* cells, GradientRowOf<Number>* gradients, const std::vector<int>& some,
                       const std::vector<int>& nodes) const {
  auto& node_rows = std::get<NodeRows<Number>>(node_rows_);
  node_rows.resize(node_start_.size() - 1);
  for (const int node : nodes) average(node, node + 1, cells);
  for (const int c : some) differentiate(c, gradients);
  if (exceptions_) exceptions_->apply(cells, gradients);
}

std::vector<int> GreenGauss::nodes_of(const std::vector<int>& cells) const {
  std::vector<int> nodes;
  for (const int c : cells) nodes.insert(nodes.end(), &cell_node_[cell_start_[c]], &cell_node_[cell_start_[c + 1] - 1] + 1);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

template void GreenGauss::apply(const RowOf<float>*, GradientRowOf<float>*, const std::vector<int>&, const std::vector<int>&) const;
template void GreenGauss::begin(const RowOf<double>*) const;
template void GreenGauss::begin(const RowOf<float>*) const;
template void GreenGauss::end(const RowOf<double>*, GradientRowOf<double>*) const;
template void GreenGauss::end(const RowOf<float>*, GradientRowOf<float>*) const;

namespace {

std::vector<int> all_cells(const Mesh& m) {
  std::vector<int> cells(m.n_gradient);
  std::iota(cells.begin(), cells.end(), 0);
  return cells;
}

}  // namespace

LeastSquares::LeastSquares(const Mesh& m) : LeastSquares(m, all_cells(m)) {}

LeastSquares::LeastSquares(const Mesh& m, std::vector<int> cells) : cell_(std::move(cells)) {
  const NodeCells nodes = collect_node_cells(m);
  start_.push_back(0);
  for (const int c : cell_) {
    std::map<int, Vec3>
        offset;  // neighbour → its centroid from here (through the shared node, so across periodic faces)
    for (Index k = m.cell_point_start[c]; k < m.cell_point_start[c + 1]; ++k) {
      const Index point = m.cell_point[k];
      const int node = nodes.used[m.point_node[point]];
      for (int j = nodes.start[node]; j < nodes.start[node + 1]; ++j)
        if (nodes.cell[j] != c)
          offset[nodes.cell[j]] =
              (m.centroid[nodes.cell[j]] - m.point[nodes.point[j]]) + (m.point[point] - m.centroid[c]);
    }
    Mat3 normal = Mat3::Zero();
    for (const auto& [other, d] : offset) normal += d * d.transpose() / d.squaredNorm();
    const Mat3 inverse = pseudo_inverse(normal).matrix;
    for (const auto& [other, d] : offset) {
      const Vec3 w = inverse * d / d.squaredNorm();
      neighbour_.push_back(other);
      coefficient_.push_back({w.x(), w.y(), w.z()});
    }
    start_.push_back(static_cast<int>(neighbour_.size()));
  }
}

template <class Number>
void LeastSquares::apply(const RowOf<Number>* cells, GradientRowOf<Number>* gradients) const {
  using P = PackOf<Number>;
  for (size_t i = 0; i < cell_.size(); ++i) {
    const P own = P::load(cells[cell_[i]].v);
    P g[3] = {0.0, 0.0, 0.0};
    for (int k = start_[i]; k < start_[i + 1]; ++k) {
      const P difference = P::load(cells[neighbour_[k]].v) - own;
      for (int d = 0; d < 3; ++d) g[d] += coefficient_[k][d] * difference;
    }
    gradients[cell_[i]].store(g);
  }
}

template void LeastSquares::apply(const RowOf<double>*, GradientRowOf<double>*) const;
template void LeastSquares::apply(const RowOf<float>*, GradientRowOf<float>*) const;

}  // namespace windhover::fluid
