#include "base/collective.h"

namespace windhover {

int rank_of(MPI_Comm comm) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  return rank;
}

int size_of(MPI_Comm comm) {
  int size = 1;
  MPI_Comm_size(comm, &size);
  return size;
}

void agree_on_error(const std::string& message, MPI_Comm comm) {
  const int mine = message.empty() ? size_of(comm) : rank_of(comm);
  int speaker = 0;
  MPI_Allreduce(&mine, &speaker, 1, MPI_INT, MPI_MIN, comm);
  if (speaker == size_of(comm)) return;
  int length = static_cast<int>(message.size());
  MPI_Bcast(&length, 1, MPI_INT, speaker, comm);
  std::string text = message;
  text.resize(length);
  MPI_Bcast(text.data(), length, MPI_CHAR, speaker, comm);
  throw UserError(text);
}

}  // namespace windhover
