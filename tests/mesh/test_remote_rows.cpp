#include <array>
#include <catch2/catch.hpp>
#include <vector>

#include "base/collective.h"
#include "mesh/remote_rows.h"

using namespace windhover;
using namespace windhover::mesh;

namespace {

constexpr int kOwn = 10, kFromEach = 4;

template <class Number>
struct Record {
  std::array<Number, 8> value{};
};

/// Each rank wants rows 7, 2, 9, 2 of every other rank, in leaves `stride` apart.
SfHandle forest(int stride) {
  const int rank = rank_of(PETSC_COMM_WORLD);
  int n_ranks = 1;
  MPI_Comm_size(PETSC_COMM_WORLD, &n_ranks);
  std::vector<PetscInt> leaves;
  std::vector<PetscSFNode> roots;
  for (int other = 0; other < n_ranks; ++other)
    for (const int row : {7, 2, 9, 2}) {
      if (other == rank) continue;
      leaves.push_back(kOwn + static_cast<PetscInt>(stride * leaves.size()));
      roots.push_back({other, row});
    }
  SfHandle sf;
  petsc(PetscSFCreate(PETSC_COMM_WORLD, sf.out()));
  petsc(PetscSFSetGraph(sf, kOwn, static_cast<PetscInt>(leaves.size()), leaves.data(), PETSC_COPY_VALUES, roots.data(),
                        PETSC_COPY_VALUES));
  return sf;
}

template <class Number>
void check_exchange(int stride) {
  const int rank = rank_of(PETSC_COMM_WORLD);
  int n_ranks = 1;
  MPI_Comm_size(PETSC_COMM_WORLD, &n_ranks);
  const SfHandle sf = forest(stride);
  RemoteRows remote(PETSC_COMM_WORLD, sf);
  std::vector<Record<Number>> rows(kOwn + stride * kFromEach * n_ranks);
  for (int turn = 0; turn < 2; ++turn) {
    for (int i = 0; i < kOwn; ++i)
      for (int k = 0; k < 8; ++k) rows[i].value[k] = static_cast<Number>(1000 * turn + 100 * rank + 10 * i + k);
    std::vector<Record<Number>> expected = rows;
    int leaf = kOwn;
    for (int other = 0; other < n_ranks; ++other)
      for (const int row : {7, 2, 9, 2}) {
        if (other == rank) continue;
        for (int k = 0; k < 8; ++k)
          expected[leaf].value[k] = static_cast<Number>(1000 * turn + 100 * other + 10 * row + k);
        leaf += stride;
      }
    remote.begin(rows.data());
    remote.end(rows.data());
    for (size_t i = 0; i < rows.size(); ++i) REQUIRE(rows[i].value == expected[i].value);
  }
}

}  // namespace

TEST_CASE("rows of other ranks arrive where they belong and nowhere else") {
  SECTION("one behind the other") { check_exchange<double>(1), check_exchange<float>(1); }
  SECTION("scattered") { check_exchange<double>(3), check_exchange<float>(3); }
}

TEST_CASE("chosen rows arrive, and those of another numbering that follows them") {
  const int rank = rank_of(PETSC_COMM_WORLD), n_ranks = size_of(PETSC_COMM_WORLD);
  const std::vector<Index> place{3, 0, 4, 1, 2};  // of each own row in the other numbering
  const auto n_own = static_cast<Index>(place.size());
  const int count = 3 - (rank + 1) % 2;  // even ranks want two rows of each other rank, odd ones three
  std::vector<RemoteRows::Peer> to, from;
  std::vector<Index> sent;
  for (int other = 0; other < n_ranks; ++other) {
    if (other == rank) continue;
    from.push_back({other, n_own + count * static_cast<Index>(from.size()), count});
    const auto first = static_cast<Index>(sent.size());
    for (Index k = 0; k < 3 - (other + 1) % 2; ++k) sent.push_back(4 - 2 * k);
    to.push_back({other, first, static_cast<Index>(sent.size()) - first});
  }
  RemoteRows chosen, following;
  chosen.choose(PETSC_COMM_WORLD, to, sent, from);
  following.follow(chosen, place, 10);
  const auto value = [](int of, Index row) { return 100.0 * of + row; };
  std::vector<double> rows(n_own + 3 * n_ranks + 10);
  const auto check = [&](RemoteRows& exchange, Index first_leaf) {
    exchange.begin(rows.data());
    exchange.end(rows.data());
    Index leaf = first_leaf;
    for (const RemoteRows::Peer& p : from)
      for (Index k = 0; k < count; ++k) REQUIRE(rows[leaf++] == value(p.rank, 4 - 2 * k));
  };
  for (Index i = 0; i < n_own; ++i) rows[i] = value(rank, i);
  check(chosen, n_own);
  for (Index i = 0; i < n_own; ++i) rows[place[i]] = value(rank, i);
  check(following, n_own + 10);
}
