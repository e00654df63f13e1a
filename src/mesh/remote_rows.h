// Rows of other ranks' cells, kept beside a rank's own ones.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstring>
#include <map>
#include <vector>

#include "base/petsc.h"
#include "mesh/mesh.h"

namespace windhover::mesh {

/// What PetscSFBcast does, for rows that are scattered where they come from: a row is copied in whole registers and asked
/// for ahead, where PETSc copies four bytes at a time.
class RemoteRows {
 public:
  RemoteRows() = default;
  /// Collective. Fastest where the leaves of each rank follow each other, in the order of the forest's list.
  RemoteRows(MPI_Comm comm, PetscSF forest);

  /// A part of a list for another rank, or from it.
  struct Peer {
    int rank = 0;
    Index first = 0, count = 0;
  };
  /// From now on sends the rows `sent`, each rank its part of them, and receives leaves where `from` says. Rank a's list for b
  /// and what b awaits from a are the same rows in the same order.
  void choose(MPI_Comm comm, std::vector<Peer> to, std::vector<Index> sent, std::vector<Peer> from);
  /// From now on exchanges what `other` does, which has chosen its rows, with own row r in place[r] and leaves so many rows
  /// further on.
  void follow(const RemoteRows& other, const std::vector<Index>& place, Index further);

  /// Fills the leaves of `rows`, plain records; between begin and end no root or leaf may change, and only exchanges of
  /// rows of different sizes may be under way. Collective.
  template <class Row>
  void begin(Row* rows) {
    begin(rows, rows);
  }
  /// Leaves in an array of their own.
  template <class Row>
  void begin(const Row* own, Row* leaves) {
    Flight& flight = flights_[sizeof(Row)];
    flight.packed.resize(sent_.size() * sizeof(Row));
    flight.received.resize(scattered_.size() * sizeof(Row));
    constexpr int kTag = static_cast<int>(sizeof(Row));
    std::byte* to = scattered_.empty() ? reinterpret_cast<std::byte*>(leaves) : flight.received.data();
    for (const Peer& p : from_) {
      flight.requests.emplace_back();
      MPI_Irecv(to + size_t(p.first) * sizeof(Row), bytes<Row>(p.count), MPI_BYTE, p.rank, kTag, comm_,
                &flight.requests.back());
    }
    for (const Peer& p : to_) {
      std::byte* packed = flight.packed.data() + size_t(p.first) * sizeof(Row);
      pack(own, p, packed);
      flight.requests.emplace_back();
      MPI_Isend(packed, bytes<Row>(p.count), MPI_BYTE, p.rank, kTag, comm_, &flight.requests.back());
    }
  }

  template <class Row>
  void end(Row* leaves) {
    Flight& flight = flights_[sizeof(Row)];
    MPI_Waitall(static_cast<int>(flight.requests.size()), flight.requests.data(), MPI_STATUSES_IGNORE);
    flight.requests.clear();
    for (size_t k = 0; k < scattered_.size(); ++k)
      std::memcpy(leaves + scattered_[k], flight.received.data() + k * sizeof(Row), sizeof(Row));
  }

 private:
  struct Flight {
    std::vector<std::byte> packed, received;
    std::vector<MPI_Request> requests;
  };

  template <class Row>
  static int bytes(Index count) {
    return static_cast<int>(count * sizeof(Row));
  }

  template <class Row>
  void pack(const Row* rows, const Peer& to, std::byte* packed) const {
    constexpr Index kAhead = 16;
    const Index* sent = sent_.data() + to.first;
    for (Index k = 0; k < to.count; ++k) {
      const auto* next = reinterpret_cast<const char*>(rows + sent[std::min(k + kAhead, to.count - 1)]);
      for (size_t at = 0; at < sizeof(Row); at += 64) __builtin_prefetch(next + at);
      std::memcpy(packed + size_t(k) * sizeof(Row), rows + sent[k], sizeof(Row));
    }
  }

  MPI_Comm comm_ = MPI_COMM_NULL;
  std::vector<Peer> to_, from_;   ///< of sent_; of scattered_, or of the rows themselves
  std::vector<Index> sent_;       ///< own rows, by the rank that wants them
  std::vector<Index> scattered_;  ///< leaves by their rank; none where those of each rank follow each other
  std::map<size_t, Flight> flights_;
};

}  // namespace windhover::mesh
