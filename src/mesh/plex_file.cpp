#include "mesh/plex_file.h"

#include <algorithm>
#include <numeric>

#include "base/errors.h"

namespace windhover::mesh {
namespace {

/// Options of our own, so that neither the command line nor the global options database is touched.
class PrivateOptions {
 public:
  PrivateOptions() { petsc(PetscOptionsCreate(&options_)); }
  ~PrivateOptions() { PetscOptionsDestroy(&options_); }
  PrivateOptions(const PrivateOptions&) = delete;
  PrivateOptions& operator=(const PrivateOptions&) = delete;
  PetscOptions get() const { return options_; }

 private:
  PetscOptions options_ = nullptr;
};

using ViewerHandle = Handle<PetscViewer, PetscViewerDestroy>;

PetscErrorCode create_plex(const std::string& file, bool binary, PetscViewer viewer, DM* dm) {
  PetscCall(PetscViewerSetType(viewer, binary ? PETSCVIEWERBINARY : PETSCVIEWERASCII));
  PetscCall(PetscViewerFileSetMode(viewer, FILE_MODE_READ));
  PetscCall(PetscViewerFileSetName(viewer, file.c_str()));
  return DMPlexCreateGmsh(PETSC_COMM_SELF, viewer, PETSC_TRUE, dm);
}

}  // namespace

DmHandle load_plex(const std::string& file, const GmshHeader& header) {
  PrivateOptions options;
  ViewerHandle viewer;
  petsc(PetscViewerCreate(PETSC_COMM_SELF, viewer.out()));
  // Prisms stay ordinary cells: Plex would turn them into "tensor" cells, whose faces do not match those of pyramids.
  petsc(PetscOptionsSetValue(options.get(), "-dm_plex_gmsh_hybrid", "false"));
  petsc(PetscObjectSetOptions(reinterpret_cast<PetscObject>(PetscViewer(viewer)), options.get()));
  DM dm = nullptr;
  petsc(PetscPushErrorHandler(PetscReturnErrorHandler, nullptr));
  const PetscErrorCode code = create_plex(file, header.binary, viewer, &dm);
  petsc(PetscPopErrorHandler());
  // A half-built DM stays behind: PETSc refuses to destroy it, and the program is about to end.
  if (code != 0) throw UserError("{}: damaged gmsh mesh, or elements that do not fit together", file);
  DmHandle owner(dm);
  PetscInt dimension = 0;
  petsc(DMGetDimension(dm, &dimension));
  if (dimension != 3) throw UserError("{}: the mesh has no three-dimensional cells", file);
  return owner;
}

std::vector<PetscInt> physical_tags(DM dm, const char* name, PetscInt begin, PetscInt end) {
  std::vector<PetscInt> tags(end - begin, 0);
  DMLabel label = nullptr;
  petsc(DMGetLabel(dm, name, &label));
  if (!label) return tags;
  IsHandle values;
  petsc(DMLabelGetValueIS(label, values.out()));
  PetscInt n_values = 0;
  const PetscInt* value = nullptr;
  petsc(ISGetLocalSize(values, &n_values));
  petsc(ISGetIndices(values, &value));
  for (PetscInt i = 0; i < n_values; ++i) {
    IsHandle points;
    petsc(DMLabelGetStratumIS(label, value[i], points.out()));
    PetscInt n_points = 0;
    const PetscInt* point = nullptr;
    petsc(ISGetLocalSize(points, &n_points));
    petsc(ISGetIndices(points, &point));
    for (PetscInt k = 0; k < n_points; ++k)
      if (point[k] >= begin && point[k] < end) tags[point[k] - begin] = value[i];
    petsc(ISRestoreIndices(points, &point));
  }
  petsc(ISRestoreIndices(values, &value));
  return tags;
}

PlexCorners corners_of(DM dm, PetscInt cell) {
  PlexCorners corners;
  PetscInt first_vertex = 0, end_vertex = 0, n_closure = 0;
  PetscInt* closure = nullptr;
  petsc(DMPlexGetDepthStratum(dm, 0, &first_vertex, &end_vertex));
  petsc(DMPlexGetTransitiveClosure(dm, cell, PETSC_TRUE, &n_closure, &closure));
  PetscInt vertices[8], order[8];
  for (PetscInt i = 0; i < n_closure; ++i)
    if (const PetscInt p = closure[2 * i]; p >= first_vertex && p < end_vertex)
      vertices[corners.size++] = p - first_vertex;
  petsc(DMPlexRestoreTransitiveClosure(dm, cell, PETSC_TRUE, &n_closure, &closure));

  std::iota(order, order + 8, 0);
  petsc(DMPlexReorderCell(dm, cell, order));
  PetscBool localised = PETSC_FALSE;
  PetscInt n_values = 0;
  const PetscScalar* array = nullptr;
  PetscScalar* values = nullptr;
  petsc(DMPlexGetCellCoordinates(dm, cell, &localised, &n_values, &array, &values));
  for (int i = 0; i < corners.size; ++i) {
    corners.vertex[i] = vertices[order[i]];
    std::copy_n(values + 3 * order[i], 3, corners.position[i]);
  }
  petsc(DMPlexRestoreCellCoordinates(dm, cell, &localised, &n_values, &array, &values));
  return corners;
}

}  // namespace windhover::mesh
