// The Euler equations on a rigidly moving mesh: rate of change of every cell, its derivative, its first-order Jacobian,
// and the loads on the boundaries. Nondimensional throughout.
#pragma once
#include <array>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "fluid/block_jacobian.h"
#include "fluid/boundary_kernels.h"
#include "fluid/extent.h"
#include "fluid/gradient.h"
#include "fluid/sliding_faces.h"
#include "fluid/zone_turn.h"
#include "mesh/mesh.h"
#include "mesh/motion.h"

namespace windhover::fluid {

enum class GradientKind { green_gauss, least_squares };

/// What is solved; names are resolved before this.
struct FlowModel {
  double gamma = 1.4;
  const FluxKernels* flux = &kRoeKernels;
  bool low_mach = true;
  Reconstruction reconstruction = Reconstruction::linear;
  GradientKind gradient = GradientKind::green_gauss;
  double limiter_epsilon = 0.01;  ///< differences below this (of the reference state) are not limited
  State<double> far{1.0, 0.0, 0.0, 0.0, 1.0 / 1.4};
  std::map<std::string, BoundaryKind> boundary;  ///< by patch name; every patch that is no interface must be here
};

/// What passes through one patch per unit time, summed over ranks, inertial axes.
struct PatchFlux {
  Flux<double> flux{};                     ///< leaving the fluid; on walls momentum is the pressure force on the wall
  mesh::Vec3 force = mesh::Vec3::Zero();   ///< of the pressure above the far field's, on what lies outside
  mesh::Vec3 moment = mesh::Vec3::Zero();  ///< of that force about the inertial origin
};

/// Places beside a patch: blocks like the patch's own, of the same cells, with arms to other places.
struct SurfacePoints {
  int patch = 0;
  std::vector<mesh::FaceBlock> blocks;
};

/// An entry of the first-order Jacobian between cells on two sides of a sliding interface; rows as SlidingFaces counts them.
struct InterfaceBlock {
  mesh::Index row, column;
  float block[28];  ///< 25 by columns; the others mean nothing
};

/// How the rate of change R enters a result: mass V x + rate R + known.
struct Combination {
  double mass = 0, rate = 1;
  Vec known = nullptr;
};

/// Rows of all cells that are known here (own, of neighbours, and of other ranks at interfaces) and their gradients.
template <class Number>
struct CellFields {
  std::vector<RowOf<Number>> cells;
  std::vector<GradientRowOf<Number>> gradients;

  void resize(size_t n_cells, size_t n_gradients) {
    cells.resize(n_cells);
    gradients.resize(n_gradients);
  }
  CellRows<Number> rows(const CellFields& derivative) const {
    return {cells.data(), gradients.data(), derivative.cells.data(), derivative.gradients.data()};
  }
};

/// Which vector, and which of the contents it has had; the same on all ranks.
struct VecContent {
  PetscObjectId id = 0;  ///< 0: none
  PetscObjectState state = 0;

  VecContent() = default;
  explicit VecContent(Vec v);
  bool operator==(const VecContent&) const = default;
};

class EulerOperator {
 public:
  /// `interfaces`: where zones of the mesh slide on each other.
  EulerOperator(const mesh::Mesh& mesh, FlowModel model, std::vector<mesh::SlidingInterface> interfaces = {});

  const mesh::Mesh& mesh() const { return mesh_; }
  const FlowModel& model() const { return model_; }
  /// Own cells of each zone.
  const std::vector<mesh::Range>& zone_cells() const { return whole_.cells; }

  /// A vector of conserved states: five per owned cell, block size 5.
  VecHandle make_vector() const;

  /// out = mass V q + rate R(q) + known, with R = Σ_faces [F(q)·A − q v_g·A] per cell (what leaves, not divided by V).
  void residual(Vec q, const Frames& frames, Vec out, const Combination& combination = {});
  /// From now on residual() keeps R: asked for R alone of the same q at the same frames, it is at hand.
  void keep_rates();

  /// Fixes the state for derivative(), until another state is asked for anything. At no cost where residual() was the last
  /// to be asked, of the same q and frames.
  void linearize(Vec q, const Frames& frames);
  /// out = (mass V + rate dR/dq) dq, exact (forward mode); dq and out in the axes from which `turn` leads to the state's.
  /// `single`: what passes through faces is made of floats, and so are its sums.
  void derivative(Vec dq, Vec out, const Combination& combination = {}, const ZoneTurn& turn = {}, bool single = false);
  /// The same of floats all through; dq and out: five per owned cell.
  void derivative(const float* dq, float* out, const Combination& combination, const ZoneTurn& turn);
  /// The same near sliding interfaces only: dq is zero but in cells within so many layers of neighbours from them, and out gets
  /// the rows of near_interfaces(), others mean nothing then. Of rows further out, what gradients make of dq there is left out, and of these nothing else.
  void derivative_near_interfaces(const float* dq, float* out, const Combination& combination, const ZoneTurn& turn);
  /// Own cells of each zone that it covers.
  const std::vector<mesh::Range>& near_interfaces() const { return near_->extent.cells; }
  /// Once, before these.
  void set_near_interfaces(int layers);

  /// jacobian = scale · d(first-order residual)/dq + diagonal(mass_scale · volume). `damping`: a speed by which the
  /// dissipation of each wave between cells is more than the residual's.
  void first_order_jacobian(Vec q, const Frames& frames, double scale, double mass_scale, BlockJacobian& jacobian,
                            double damping = 0);

  /// blocks: scale · d(first-order residual)/dq between owned cells and those of other zones, one for each piece of an
  /// interface, in the axes from which `turn` leads to those of `frames`.
  void interface_jacobian(Vec q, const Frames& frames, double scale, const ZoneTurn& turn,
                          std::vector<InterfaceBlock>& blocks);
  const SlidingFaces& sliding_faces() const { return sliding_; }
  /// As SlidingFaces::others(). Collective.
  const mesh::RemoteRows& others_at_interfaces(const Frames& frames) { return sliding_.others(frames); }

  /// Sums over the whole domain of volume times mass, momentum and energy. Collective.
  std::array<double, kVariables> total(Vec q) const;

  /// One entry per mesh patch.
  std::vector<PatchFlux> patch_fluxes(Vec q, const Frames& frames);
  /// States that the boundary conditions give at each of these sets of places, in the order of its blocks' lanes.
  std::vector<std::vector<State<double>>> surface_states(Vec q, const Frames& frames,
                                                         std::span<const SurfacePoints> points);
  /// States at the face centroids of a patch, in the order of its blocks' lanes (owned by this rank).
  std::vector<State<double>> patch_states(Vec q, const Frames& frames, int patch);

  /// Density and pressure are positive everywhere. Collective.
  bool is_physical(Vec q) const;

  /// Λ = ½ Σ_faces (|u·n − v_g·n| + c) |A| of each owned cell: Λ/V bounds how fast sound makes the cell change.
  std::vector<double> spectral_radii(Vec q, const Frames& frames);
  /// Largest acoustic Courant number Λ dt / V; all ranks.
  double courant_number(Vec q, const Frames& frames, double dt);

 private:
  template <class T>
  T mach_column(const State<T>& s, const PackFor<T> grid[3]) const;
  void fill_cells(Vec q, const Frames& frames);
  template <class Number, class Scalar>
  void fill_derivatives(const Scalar* dq, const ZoneTurn& turn, const Extent& extent, const CellFields<Number>& state,
                        CellFields<Number>& derivative);
  template <class Number, class Scalar>
  void derivative_of(const Scalar* dq, Scalar* out, const Combination& combination, const ZoneTurn& turn);
  void round_state();
  bool holds(Vec q, const Frames& frames) const;
  void hold(Vec q, const Frames& frames);
  void load_cells(Vec q, const Frames& frames);
  template <class Number>
  void complete(CellFields<Number>& fields);
  void complete_near_interfaces();
  template <class Number>
  void begin_interfaces(CellFields<Number>& fields, const Frames& frames);
  template <class Number>
  void end_interfaces(CellFields<Number>& fields, const Frames& frames);
  FaceInput face_input(const mesh::FrameState& frame, const Extent& extent) const;
  FaceInput face_input(const mesh::FrameState& frame) const { return face_input(frame, whole_); }
  /// The mesh's faces, of floats from the first time round_state() was called.
  template <class Number>
  const std::vector<mesh::FaceBlockOf<Number>>& zone_faces() const {
    if constexpr (std::is_same_v<Number, float>)
      return single_faces_.zones;
    else
      return mesh_.faces;
  }
  template <class Number>
  const std::vector<mesh::FaceBlockOf<Number>>& patch_faces(size_t patch) const {
    if constexpr (std::is_same_v<Number, float>)
      return single_faces_.patches[patch];
    else
      return mesh_.patches[patch].blocks;
  }
  /// Calls visit(input, blocks, count) for the faces inside each zone.
  template <class Number = double, class Visit>
  void for_each_zone(const Frames& frames, const Extent& extent, Visit visit) const {
    for (size_t z = 0; z < frames.size(); ++z) {
      const mesh::Range& range = extent.faces[z];
      visit(face_input(frames[z], extent), zone_faces<Number>().data() + range.begin, static_cast<int>(range.size()));
    }
  }
  /// Calls visit(input, kind, blocks, count, patch) for the faces of each patch.
  template <class Number = double, class Visit>
  void for_each_patch(const Frames& frames, const Extent& extent, Visit visit) const {
    for (size_t p = 0; p < mesh_.patches.size(); ++p) {
      if (!patch_kind_[p]) continue;
      visit(face_input(frames[mesh_.patches[p].zone], extent), *patch_kind_[p], patch_faces<Number>(p).data(),
            extent.patch_blocks[p], static_cast<int>(p));
    }
  }
  /// Calls visit(input, blocks, count) for the faces of each sliding interface that have a cell here.
  template <class Number = double, class Visit>
  void for_each_interface(const Frames& frames, const Extent& extent, Visit visit) {
    if (sliding_.empty()) return;
    const auto& interfaces = sliding_.faces<Number>(frames);
    for (size_t i = 0; i < interfaces.size(); ++i)
      visit(face_input(frames[sliding_.frame_zone(i)], extent), interfaces[i].data(), static_cast<int>(interfaces[i].size()));
  }
  template <class Number>
  void sum_rates(CellFields<Number>& fields, const Frames& frames, const Extent& extent, FluxKernels::Sum<Number> interior,
                 BoundaryKernels::Sum<Number> boundary);
  template <class Number, class Scalar>
  void store_rates(const Scalar* x, Scalar* out, const Combination& combination, const Extent& extent, const ZoneTurn& turn = {},
                   double* rate = nullptr);
  void prepare(Vec q, const Frames& frames);
  /// Sums of doubles, or of floats in the same memory: they are never made at once, and zeros in between.
  template <class Number>
  RowOf<Number>* rates() {
    return reinterpret_cast<RowOf<Number>*>(rates_.data());
  }

  const mesh::Mesh& mesh_;
  FlowModel model_;
  SlidingFaces sliding_;
  mesh::RemoteRows halo_;
  std::vector<std::optional<BoundaryKind>> patch_kind_;  ///< none: an interface
  Extent whole_;
  std::optional<GreenGauss> green_gauss_;
  std::optional<LeastSquares> least_squares_;
  CellFields<double> state_, derivative_;
  CellFields<float> state_single_, derivative_single_;  ///< from the first time they are asked for
  struct Near {
    Extent extent;
    std::vector<int> nodes;  ///< of extent.gradients
    std::optional<LeastSquares> least_squares;
    CellFields<float> derivative;  ///< zero but in the extent
  };
  std::optional<Near> near_;
  struct {
    std::vector<mesh::SingleFaceBlock> zones;
    std::vector<std::vector<mesh::SingleFaceBlock>> patches;
  } single_faces_;
  std::vector<Row> rates_;                              ///< zero but between sum_rates() and store_rates()
  /// The state whose rows and gradients are in state_, those of other ranks and at interfaces as well.
  struct {
    VecContent content;
    Frames frames;
    bool rate = false;    ///< rate_ is of it
    bool single = false;  ///< state_single_ is
  } held_;
  VecHandle rate_;
};

}  // namespace windhover::fluid
