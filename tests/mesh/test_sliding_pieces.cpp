// Pieces in which the faces of the two sides of a sliding interface meet.
#include <catch2/catch.hpp>
#include <numbers>

#include "base/collective.h"
#include "sliding_fixture.h"

using namespace windhover;
using namespace windhover::mesh;
using std::numbers::pi;

namespace {

/// Angles over a whole turn and beyond, tiny ones, and those where seams and equal rims coincide.
std::vector<double> many_angles() {
  std::vector<double> angles{0,      1e-9,          -1e-9,           1e-13, pi / 2, pi,    -pi,
                             2 * pi, 2 * pi - 1e-9, 2 * pi * 5 / 18, 7.3,   -11.9,  1234.5};
  for (int k = 0; k < 12; ++k) angles.push_back(0.01 + k * 2 * pi / 12);
  return angles;
}

void check_sums(const SlidingCase& c) {
  for (const double angle : many_angles()) {
    INFO("angle " << angle);
    const std::vector<Piece> pieces = c.interface().pieces(angle);
    CHECK(c.interface().audit(angle, pieces) < 1e-12);
  }
}

Vec3 turn(const SlidingSurface& s, const Vec3& r, double angle) {
  return s.point + Eigen::AngleAxisd(angle, s.axis.normalized()) * (r - s.point);
}

/// Each piece lies on Γ between its cells, and no spin about the axis moves it along its normal.
void check_pieces(const SlidingCase& c, const SlidingSurface& s, double angle) {
  const RevolutionSurface surface(s);
  const SlidingInterface& interface = c.interface();
  double off = 0, arm = 0, spin = 0, size = 0;
  for (const Piece& piece : interface.pieces(angle)) {
    const InterfaceFace &inner = interface.faces(0)[piece.inner], &outer = interface.faces(1)[piece.outer];
    off = std::max(off, surface.place(surface.to_local(piece.centroid)).distance);
    arm = std::max(arm, (turn(s, inner.cell_centroid + piece.arm[0], angle) - piece.centroid).norm());
    arm = std::max(arm, (outer.cell_centroid + piece.arm[1] - piece.centroid).norm());
    spin =
        std::max(spin, std::abs(s.axis.normalized().dot(piece.moment - s.point.cross(piece.area))) / piece.area.norm());
    if (inner.rank == rank_of(c.mesh.comm)) size += piece.area.norm();
  }
  CHECK(off < 1e-14);
  CHECK(arm < 1e-14);
  CHECK(spin < 1e-15);
  CHECK(total(size, c.mesh.comm) > 0.98 * 2 * pi * 0.5 * 0.5);
}

}  // namespace

TEST_CASE("pieces of a cylinder add up to its faces at any angle") {
  const SlidingCase c = cylinder_case();
  check_sums(c);
  check_pieces(c, rotor_surface(), 0.7);
}

TEST_CASE("pieces of coarse, of layered and of equally divided cylinders add up") {
  check_sums(cylinder_case({{"h_in", 0.6}, {"h_out", 0.3}}));
  check_sums(cylinder_case({{"layers", 4}, {"h_in", 0.2}}));
  check_sums(cylinder_case({{"layers", 3}, {"quads", 1}}));
  check_sums(cylinder_case({{"rim", 18}}));
}

TEST_CASE("common nodes: a piece for each face at angle 0, slivers at a tiny angle") {
  const SlidingSurface surface{.radius = 0.6, .z1 = 0.5};
  const SlidingCase c = make_sliding(make_mesh("cylinder_shared"), surface, "rotor", "ball");
  check_sums(c);
  std::size_t own = 0;
  for (int f = 0; f < static_cast<int>(c.interface().faces(0).size()); ++f)
    if (c.interface().faces(0)[f].rank == rank_of(c.mesh.comm)) ++own;
  std::size_t whole = 0, slivers = 0;
  for (const Piece& piece : c.interface().pieces(0)) {
    const InterfaceFace &inner = c.interface().faces(0)[piece.inner], &outer = c.interface().faces(1)[piece.outer];
    CHECK((inner.area - outer.area).norm() < 1e-15);
    CHECK((inner.area - piece.area).norm() < 1e-15);
    if (inner.rank == rank_of(c.mesh.comm)) ++whole;
  }
  CHECK(whole == own);
  for (const Piece& piece : c.interface().pieces(1e-9)) {
    const InterfaceFace& inner = c.interface().faces(0)[piece.inner];
    if (inner.rank == rank_of(c.mesh.comm) && piece.area.norm() < 1e-8 * inner.size) ++slivers;
  }
  CHECK(total(slivers, c.mesh.comm) > 150);
}

TEST_CASE("pieces of a sphere add up to its faces at any angle") {
  const SlidingCase c = sphere_case();
  check_sums(c);
  check_pieces(c, ball_surface(), 0.7);
  check_sums(sphere_case({{"h_in", 0.5}, {"h_out", 0.5}}));
}

TEST_CASE("the number of pieces grows with the number of faces") {
  for (const double refinement : {1.0, 2.0}) {
    const SlidingCase c = cylinder_case({{"h_in", 0.2 / refinement}, {"h_out", 0.4 / refinement}}, PETSC_COMM_SELF);
    const std::size_t faces = c.interface().faces(0).size() + c.interface().faces(1).size();
    CHECK(c.interface().pieces(1).size() < 3 * faces);
  }
}

TEST_CASE("any number of ranks gives the same pieces") {
  for (const bool sphere : {false, true}) {
    const SlidingCase all = sphere ? sphere_case() : cylinder_case();
    const SlidingCase alone = sphere ? sphere_case({}, PETSC_COMM_SELF) : cylinder_case({}, PETSC_COMM_SELF);
    const std::vector<Piece> part = all.interface().pieces(0.3), whole = alone.interface().pieces(0.3);
    double own = 0;
    std::size_t next = 0;
    bool same = true;
    for (const Piece& p : part) {
      while (next < whole.size() && (whole[next].inner != p.inner || whole[next].outer != p.outer)) ++next;
      REQUIRE(next < whole.size());
      const Piece& q = whole[next];
      same = same && p.area == q.area && p.moment == q.moment && p.centroid == q.centroid && p.arm == q.arm;
      const int inner = all.interface().faces(0)[p.inner].rank, outer = all.interface().faces(1)[p.outer].rank;
      const int rank = rank_of(all.mesh.comm);
      CHECK((inner == rank || outer == rank));
      own += (inner == rank ? 0.5 : 0) + (outer == rank ? 0.5 : 0);
    }
    CHECK(same);
    CHECK(total(own, all.mesh.comm) == static_cast<double>(whole.size()));
  }
}

TEST_CASE("the audit finds a missing piece") {
  const SlidingCase c = sphere_case();
  std::vector<Piece> pieces = c.interface().pieces(0.3);
  if (rank_of(c.mesh.comm) == 0) pieces.pop_back();
  CHECK_THROWS_AS(c.interface().audit(0.3, pieces), SolverFailure);
}
