// PETSc from C++: error codes become exceptions, objects have owners, and callbacks never leak exceptions.
#pragma once
#include <petscsnes.h>
#include <petscsf.h>

#include <exception>
#include <stdexcept>
#include <string>
#include <utility>

namespace windhover {

/// Throws when a PETSc call returns an error (PETSc has already printed its own trace).
inline void petsc(PetscErrorCode code) {
  if (code == 0) return;
  const char* text = nullptr;
  PetscErrorMessage(code, &text, nullptr);
  throw std::runtime_error(std::string("PETSc: ") + (text ? text : "unknown error"));
}

/// Unique owner of a PETSc object: Handle<Vec, VecDestroy>.
template <class T, PetscErrorCode (*Destroy)(T*)>
class Handle {
 public:
  Handle() = default;
  explicit Handle(T object) : object_(object) {}
  Handle(Handle&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(object_, other.object_);
    return *this;
  }
  ~Handle() {
    if (object_) Destroy(&object_);
  }
  operator T() const { return object_; }
  /// For PETSc's "create into pointer" calls; releases what was held.
  T* out() {
    if (object_) Destroy(&object_);
    object_ = nullptr;
    return &object_;
  }

 private:
  T object_ = nullptr;
};

using VecHandle = Handle<Vec, VecDestroy>;
using MatHandle = Handle<Mat, MatDestroy>;
using KspHandle = Handle<KSP, KSPDestroy>;
using SnesHandle = Handle<SNES, SNESDestroy>;
using SfHandle = Handle<PetscSF, PetscSFDestroy>;
using IsHandle = Handle<IS, ISDestroy>;
using ScatterHandle = Handle<VecScatter, VecScatterDestroy>;

/// Holds the first exception of a C callback until control is back in C++ (pattern: deal.II sundials/utilities.h).
class CallbackGuard {
 public:
  template <class F>
  PetscErrorCode run(F&& body) noexcept {
    try {
      body();
      return 0;
    } catch (...) {
      if (!pending_) pending_ = std::current_exception();
      return PETSC_ERR_LIB;
    }
  }
  void rethrow() {
    if (pending_) std::rethrow_exception(std::exchange(pending_, nullptr));
  }

 private:
  std::exception_ptr pending_;
};

}  // namespace windhover
