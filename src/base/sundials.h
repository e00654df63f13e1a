// Owners of SUNDIALS objects on one process. Only for folders that link SUNDIALS.
#pragma once
#include <nvector/nvector_serial.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>

#include <memory>
#include <span>
#include <stdexcept>
#include <type_traits>

namespace windhover::sundials {

template <auto Free>
struct Release {
  template <class T>
  void operator()(T* object) const {
    Free(object);
  }
};
/// For solvers, whose functions want the address of the pointer.
template <auto Free>
struct ReleaseMemory {
  void operator()(void* memory) const { Free(&memory); }
};
inline void free_context(SUNContext context) { SUNContext_Free(&context); }

using Context = std::unique_ptr<_SUNContext, Release<free_context>>;
using Vector = std::unique_ptr<std::remove_pointer_t<N_Vector>, Release<N_VDestroy>>;
using Matrix = std::unique_ptr<std::remove_pointer_t<SUNMatrix>, Release<SUNMatDestroy>>;
using LinearSolver = std::unique_ptr<std::remove_pointer_t<SUNLinearSolver>, Release<SUNLinSolFree>>;

inline Context make_context() {
  SUNContext context = nullptr;
  if (SUNContext_Create(nullptr, &context) != 0) throw std::runtime_error("SUNDIALS: no context");
  return Context(context);
}

inline std::span<double> values(N_Vector v) {
  return {N_VGetArrayPointer(v), static_cast<std::size_t>(NV_LENGTH_S(v))};
}

}  // namespace windhover::sundials
