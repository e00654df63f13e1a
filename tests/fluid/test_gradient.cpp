// Gradients of linear fields are exact on every mesh, boundary cells included.
#include <catch2/catch.hpp>

#include "fluid/gradient.h"
#include "flow_fixture.h"

using namespace windhover;
using namespace windhover::fluid;

namespace {

/// Largest error of the gradient of slope·x over cells and columns; `dimensions` 2 leaves z out.
template <class Gradient>
double largest_error(const mesh::Mesh& mesh, int dimensions) {
  const Gradient gradient(mesh);
  std::vector<Row> rows(mesh.n_cells);
  std::vector<GradientRow> out(mesh.n_gradient);
  mesh::Vec3 slope[8];
  for (int k = 0; k < 8; ++k) slope[k] = mesh::Vec3(1 + k, 2 - 0.5 * k, dimensions == 3 ? 0.3 * k - 1 : 0.0);
  for (mesh::Index c = 0; c < mesh.n_cells; ++c)
    for (int k = 0; k < 8; ++k) rows[c].v[k] = 3 + slope[k].dot(mesh.centroid[c]);
  gradient.apply(rows.data(), out.data());
  double worst = 0;
  for (mesh::Index c = 0; c < mesh.n_gradient; ++c)
    for (int k = 0; k < kVariables; ++k)
      for (int d = 0; d < 3; ++d) worst = std::max(worst, std::abs(out[c].at(d, k) - slope[k][d]));
  return worst;
}

}  // namespace

TEST_CASE("gradients of linear fields are exact", "[gradient]") {
  const auto [name, numbers, dimensions] = GENERATE(table<std::string, std::map<std::string, double>, int>(
      {{"cube", {{"n", 6}}, 3}, {"box", {}, 3}, {"prisms", {{"nz", 3}}, 3}, {"prisms", {{"nz", 1}}, 2}, {"mixed", {}, 3}}));
  CAPTURE(name, dimensions);
  const mesh::Mesh mesh = mesh::read_mesh(make_mesh(name, numbers), 1.0, PETSC_COMM_WORLD);
  CHECK(largest_error<GreenGauss>(mesh, dimensions) < 1e-11);
  CHECK(largest_error<LeastSquares>(mesh, dimensions) < 1e-11);
}
