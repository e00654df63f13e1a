#include "fluid/single_vector.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/pack.h"
// needs PETSc's types before it
#include <petsc/private/vecimpl.h>

namespace windhover::fluid {
namespace {

constexpr PetscInt kBlock = 1024;  // floats: several vectors' blocks stay in the cache, and a block's sum may be of floats

PetscInt size_of(Vec v) { return 2 * v->map->n; }

/// Calls visit(first, count) for each block of n floats.
template <class Visit>
void for_each_block(PetscInt n, Visit visit) {
  for (PetscInt first = 0; first < n; first += kBlock) visit(first, std::min(kBlock, n - first));
}

std::vector<const float*> values_of(PetscInt count, const Vec* v) {
  std::vector<const float*> values(count);
  std::transform(v, v + count, values.begin(), single_values_read);
  return values;
}

double dot_of_block(const float* x, const float* y, PetscInt n) {
  typedef Lanes<16, float> Sum;
  Sum sum(0.0);
  PetscInt i = 0;
  for (; i + Sum::size <= n; i += Sum::size) sum += Sum::load_unaligned(x + i) * Sum::load_unaligned(y + i);
  double total = 0;
  for (int k = 0; k < Sum::size; ++k) total += sum[k];
  for (; i < n; ++i) total += static_cast<double>(x[i]) * y[i];
  return total;
}

PetscErrorCode dots(Vec x, PetscInt count, const Vec y[], PetscScalar* results) {
  return CallbackGuard().run([=] {
    std::fill(results, results + count, 0.0);
    const auto from = values_of(count, y);
    const float* values = single_values_read(x);
    for_each_block(size_of(x), [&](PetscInt first, PetscInt n) {
      for (PetscInt k = 0; k < count; ++k) results[k] += dot_of_block(values + first, from[k] + first, n);
    });
    MPI_Allreduce(MPI_IN_PLACE, results, static_cast<int>(count), MPI_DOUBLE, MPI_SUM,
                  PetscObjectComm(reinterpret_cast<PetscObject>(x)));
  });
}

PetscErrorCode dot(Vec x, Vec y, PetscScalar* result) { return dots(x, 1, &y, result); }

PetscErrorCode norm(Vec x, NormType type, PetscReal* result) {
  if (type != NORM_2) return PETSC_ERR_SUP;
  const PetscErrorCode code = dots(x, 1, &x, result);
  *result = std::sqrt(*result);
  return code;
}

/// y = own y + Σ factors[k] x[k]
PetscErrorCode combine(Vec y, double own, PetscInt count, const PetscScalar* factors, const Vec* x) {
  return CallbackGuard().run([=] {
    const auto from = values_of(count, x);
    float* values = single_values(y);
    for_each_block(size_of(y), [&](PetscInt first, PetscInt n) {
      float* const sum = values + first;
      if (own != 1)
        for (PetscInt i = 0; i < n; ++i) sum[i] *= static_cast<float>(own);
      for (PetscInt k = 0; k < count; ++k) {
        const float *term = from[k] + first, factor = static_cast<float>(factors[k]);
        for (PetscInt i = 0; i < n; ++i) sum[i] += factor * term[i];
      }
    });
  });
}

PetscErrorCode add_many(Vec y, PetscInt count, const PetscScalar* factors, Vec* x) { return combine(y, 1, count, factors, x); }
PetscErrorCode add(Vec y, PetscScalar factor, Vec x) { return combine(y, 1, 1, &factor, &x); }
PetscErrorCode scale(Vec y, PetscScalar factor) { return combine(y, factor, 0, nullptr, nullptr); }
PetscErrorCode scale_and_add(Vec y, PetscScalar factor, Vec x) {
  constexpr PetscScalar kOne = 1;
  return combine(y, factor, 1, &kOne, &x);
}
PetscErrorCode add_into(Vec w, PetscScalar factor, Vec x, Vec y) {
  const PetscErrorCode code = VecCopy(y, w);
  return code ? code : add(w, factor, x);
}

PetscErrorCode set(Vec v, PetscScalar value) {
  if (value != 0) return PETSC_ERR_SUP;  // there may be a float too many
  return CallbackGuard().run([=] { std::fill_n(single_values(v), size_of(v), 0.0f); });
}

/// Of all that PETSc's own vectors can do, what is as true of two floats in an entry.
void keep_storage_alone(_VecOps& ops) {
  const _VecOps all = ops;
  ops = {};
  ops.duplicate = all.duplicate;
  ops.duplicatevecs = all.duplicatevecs;
  ops.destroyvecs = all.destroyvecs;
  ops.destroy = all.destroy;
  ops.copy = all.copy;
  ops.getsize = all.getsize;
  ops.getlocalsize = all.getlocalsize;
  ops.assemblybegin = all.assemblybegin;
  ops.assemblyend = all.assemblyend;
}

}  // namespace

VecHandle make_single_vector(MPI_Comm comm, PetscInt n) {
  VecHandle v;
  petsc(VecCreateMPI(comm, (n + 1) / 2, PETSC_DETERMINE, v.out()));
  _VecOps& ops = *static_cast<Vec>(v)->ops;  // duplicates get the same
  keep_storage_alone(ops);
  ops.dot = dot;
  ops.mdot = dots;
  ops.norm = norm;
  ops.scale = scale;
  ops.set = set;
  ops.axpy = add;
  ops.maxpy = add_many;
  ops.aypx = scale_and_add;
  ops.waxpy = add_into;
  return v;
}

float* single_values(Vec v) {
  double* entries = nullptr;
  petsc(VecGetArray(v, &entries));
  float* values = reinterpret_cast<float*>(entries);
  petsc(VecRestoreArray(v, &entries));
  return values;
}

const float* single_values_read(Vec v) {
  const double* entries = nullptr;
  petsc(VecGetArrayRead(v, &entries));
  const float* values = reinterpret_cast<const float*>(entries);
  petsc(VecRestoreArrayRead(v, &entries));
  return values;
}

}  // namespace windhover::fluid
