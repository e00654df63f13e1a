// What the flow does at its boundaries: loads, fluxes, surface states.
#include <algorithm>
#include <cmath>

#include "fluid/euler.h"

namespace windhover::fluid {

using mesh::FaceBlock;
using mesh::Vec3;

namespace {

Vec3 lane(const double field[3][mesh::kLanes], int i) { return {field[0][i], field[1][i], field[2][i]}; }

State<double> lane(const State<Pack>& s, int i) { return {s.rho[i], s.u[i], s.v[i], s.w[i], s.p[i]}; }

}  // namespace

std::array<double, kVariables> EulerOperator::total(Vec state) const {
  const double* q = nullptr;
  petsc(VecGetArrayRead(state, &q));
  std::array<double, kVariables> sum{};
  for (mesh::Index c = 0; c < mesh_.n_owned; ++c)
    for (int k = 0; k < kVariables; ++k) sum[k] += mesh_.volume[c] * q[kVariables * c + k];
  petsc(VecRestoreArrayRead(state, &q));
  MPI_Allreduce(MPI_IN_PLACE, sum.data(), kVariables, MPI_DOUBLE, MPI_SUM, mesh_.comm);
  return sum;
}

bool EulerOperator::is_physical(Vec state) const {
  const double* q = nullptr;
  petsc(VecGetArrayRead(state, &q));
  int good = 1;
  for (mesh::Index c = 0; c < mesh_.n_owned && good; ++c)
    good = q[5 * c] > 0 && primitive(q + 5 * c, model_.gamma).p > 0;  // false for NaN, too
  petsc(VecRestoreArrayRead(state, &q));
  MPI_Allreduce(MPI_IN_PLACE, &good, 1, MPI_INT, MPI_MIN, mesh_.comm);
  return good;
}

std::vector<PatchFlux> EulerOperator::patch_fluxes(Vec q, const Frames& frames) {
  prepare(q, frames);
  const int r = static_cast<int>(model_.reconstruction);
  std::vector<PatchFlux> sums(mesh_.patches.size());
  for_each_patch(frames, whole_, [&](const FaceInput& in, BoundaryKind kind, const FaceBlock* blocks, int n, int p) {
    const mesh::FrameState& frame = frames[mesh_.patches[p].zone];
    PatchFlux& sum = sums[p];
    for (const FaceBlock* b = blocks; b < blocks + n; ++b) {
      const State<Pack> states = kBoundaryKernels.state[r](in, kind, *b);
      const auto face = face_geometry<Pack>(in, *b);
      const Flux<Pack> flux = face.area * physical_flux(states, face.normal, in.gamma);
      for (int i = 0; i < b->count; ++i) {
        sum.flux = sum.flux + Flux<double>{flux.mass[i], flux.x[i], flux.y[i], flux.z[i], flux.energy[i]};
        const double gauge = states.p[i] - model_.far.p;
        const Vec3 force = gauge * (frame.R * lane(b->area, i));
        sum.force += force;
        sum.moment += gauge * (frame.R * lane(b->moment, i)) + frame.x.cross(force);
      }
    }
  });
  static_assert(sizeof(PatchFlux) == 11 * sizeof(double));
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(11 * sums.size()), MPI_DOUBLE, MPI_SUM, mesh_.comm);
  return sums;
}

std::vector<std::vector<State<double>>> EulerOperator::surface_states(Vec q, const Frames& frames,
                                                                      std::span<const SurfacePoints> points) {
  prepare(q, frames);
  const int r = static_cast<int>(model_.reconstruction);
  std::vector<std::vector<State<double>>> states;
  for (const SurfacePoints& set : points) {
    const FaceInput in = face_input(frames[mesh_.patches[set.patch].zone]);
    auto& here = states.emplace_back();
    for (const FaceBlock& b : set.blocks) {
      const State<Pack> s = kBoundaryKernels.state[r](in, *patch_kind_[set.patch], b);
      for (int i = 0; i < b.count; ++i) here.push_back(lane(s, i));
    }
  }
  return states;
}

std::vector<State<double>> EulerOperator::patch_states(Vec q, const Frames& frames, int patch) {
  const SurfacePoints faces{patch, mesh_.patches[patch].blocks};
  return surface_states(q, frames, {&faces, 1}).front();
}

std::vector<double> EulerOperator::spectral_radii(Vec q, const Frames& frames) {
  load_cells(q, frames);
  std::vector<double> radii(rates_.size(), 0.0);
  const auto add = [&](const FaceInput& in, const FaceBlock* blocks, int n, int sides) {
    for (const FaceBlock* b = blocks; b < blocks + n; ++b) {
      const auto face = face_geometry<Pack>(in, *b);
      for (int side = 0; side < sides; ++side) {
        const State<Pack> s = face_side<Reconstruction::first_order, Pack>(in, *b, side).state;
        const Pack speed =
            absolute(normal_speed(s, face.normal) - face.normal.grid_speed) + sqrt(in.gamma * s.p / s.rho);
        for (int i = 0; i < b->count; ++i) radii[b->cell[side][i]] += 0.5 * (face.area * speed)[i];
      }
    }
  };
  const auto add_both = [&](const FaceInput& in, const FaceBlock* blocks, int n) { add(in, blocks, n, 2); };
  for_each_interface(frames, whole_, add_both);
  for_each_zone(frames, whole_, add_both);
  for_each_patch(
      frames, whole_, [&](const FaceInput& in, BoundaryKind, const FaceBlock* blocks, int n, int) { add(in, blocks, n, 1); });
  radii.resize(mesh_.n_owned);
  return radii;
}

double EulerOperator::courant_number(Vec q, const Frames& frames, double dt) {
  const std::vector<double> radii = spectral_radii(q, frames);
  double largest = 0;
  for (mesh::Index c = 0; c < mesh_.n_owned; ++c) largest = std::max(largest, dt * radii[c] / mesh_.volume[c]);
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, mesh_.comm);
  return largest;
}

}  // namespace windhover::fluid
