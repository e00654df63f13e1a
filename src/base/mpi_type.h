// So many numbers, or bytes of a plain record, as one item of MPI: counts in items stay below the limit of int.
#pragma once
#include <mpi.h>

namespace windhover {

class MpiType {
 public:
  explicit MpiType(int n, MPI_Datatype each = MPI_DOUBLE) {
    MPI_Type_contiguous(n, each, &type_);
    MPI_Type_commit(&type_);
  }
  ~MpiType() { MPI_Type_free(&type_); }
  MpiType(const MpiType&) = delete;
  MpiType& operator=(const MpiType&) = delete;
  operator MPI_Datatype() const { return type_; }

 private:
  MPI_Datatype type_ = MPI_DATATYPE_NULL;
};

}  // namespace windhover
