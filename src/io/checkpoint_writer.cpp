
#include "base/collective.h"
#include "io/checkpoint.h"
#include "io/checkpoint_files.h"
#include "io/file.h"

namespace windhover::io {

namespace fs = std::filesystem;

/// Room for what HDF5 keeps about a table.
constexpr std::uint64_t metadata_bytes = 64 * 1024;

CheckpointWriter::CheckpointWriter(const fs::path& directory, std::int64_t step, MPI_Comm comm)
    : folder_(checkpoint_folder(directory)),
      path_(folder_ / checkpoint_name(step)),
      temporary_(path_.string() + ".tmp"),
      comm_(comm) {
  on_root(comm_, [&] {
    make_folder(folder_);
    OutputFile(temporary_, OutputFile::Mode::create);
  });
  reserve(bytes_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const HdfHandle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_mpio(access, comm_, MPI_INFO_NULL);
  file_ = HdfHandle(H5Fcreate(temporary_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose);
  check(file_ >= 0);
  reserve(bytes_);
  attribute(format_attribute, Attribute(std::int64_t(checkpoint_format)));
}

CheckpointWriter::~CheckpointWriter() {
  file_.close();
  remove_temporary();
}

void CheckpointWriter::remove_temporary() const {
  std::error_code ignored;
  if (rank_of(comm_) == 0) fs::remove(temporary_, ignored);
}

void CheckpointWriter::check(bool success) const {
  collectively(comm_, [&] {
    if (!success) throw UserError("{}: cannot write this checkpoint", path_.string());
  });
}

// Ranks that meet a full disk inside HDF5 wait for each other for ever, so the space is there before HDF5 writes.
void CheckpointWriter::reserve(std::uint64_t bytes) const {
  try {
    on_root(comm_, [&] { OutputFile(temporary_, OutputFile::Mode::append).reserve(bytes); });
  } catch (const UserError&) {
    remove_temporary();
    throw;
  }
}

void CheckpointWriter::attribute(const std::string& name, const Attribute& value) {
  struct Layout {
    HdfHandle type, space;
    const void* data;
  };
  const auto scalar = [](hid_t type, const void* data) {
    return Layout{HdfHandle(H5Tcopy(type), H5Tclose), HdfHandle(H5Screate(H5S_SCALAR), H5Sclose), data};
  };
  struct Describe {
    decltype(scalar)& of;
    Layout operator()(const double& v) const { return of(H5T_NATIVE_DOUBLE, &v); }
    Layout operator()(const std::int64_t& v) const { return of(H5T_NATIVE_INT64, &v); }
    Layout operator()(const std::uint64_t& v) const { return of(H5T_NATIVE_UINT64, &v); }
    Layout operator()(const std::string& v) const {
      Layout layout = of(H5T_C_S1, v.c_str());
      H5Tset_size(layout.type, v.size() + 1);
      return layout;
    }
    Layout operator()(const std::vector<double>& v) const {
      const hsize_t size = v.size();
      return {HdfHandle(H5Tcopy(H5T_NATIVE_DOUBLE), H5Tclose), HdfHandle(H5Screate_simple(1, &size, nullptr), H5Sclose),
              v.data()};
    }
  };
  const Layout layout = std::visit(Describe{scalar}, value);
  const HdfHandle attribute(H5Acreate2(file_, name.c_str(), layout.type, layout.space, H5P_DEFAULT, H5P_DEFAULT),
                            H5Aclose);
  check(attribute >= 0 && H5Awrite(attribute, layout.type, layout.data) >= 0);
}

void CheckpointWriter::array(const std::string& name, std::span<const double> rows, int columns) {
  const std::int64_t mine = std::int64_t(rows.size()) / columns;
  std::int64_t end = 0, total = 0;
  MPI_Scan(&mine, &end, 1, MPI_INT64_T, MPI_SUM, comm_);
  MPI_Allreduce(&mine, &total, 1, MPI_INT64_T, MPI_SUM, comm_);
  const hsize_t size[2] = {hsize_t(total), hsize_t(columns)};
  const hsize_t offset[2] = {hsize_t(end - mine), 0}, count[2] = {hsize_t(mine), hsize_t(columns)};
  bytes_ += size[0] * size[1] * sizeof(double) + metadata_bytes;
  reserve(bytes_);
  const HdfHandle space(H5Screate_simple(2, size, nullptr), H5Sclose);
  const HdfHandle memory(H5Screate_simple(2, count, nullptr), H5Sclose);
  const HdfHandle data(H5Dcreate2(file_, name.c_str(), H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                       H5Dclose);
  const HdfHandle transfer(H5Pcreate(H5P_DATASET_XFER), H5Pclose);
  H5Pset_dxpl_mpio(transfer, H5FD_MPIO_COLLECTIVE);
  H5Sselect_hyperslab(space, H5S_SELECT_SET, offset, nullptr, count, nullptr);
  check(data >= 0 && H5Dwrite(data, H5T_NATIVE_DOUBLE, memory, space, transfer, rows.data()) >= 0);
}

void CheckpointWriter::finish() {
  const bool flushed = H5Fflush(file_, H5F_SCOPE_GLOBAL) >= 0;
  check(file_.close() && flushed);
  constexpr size_t kept = 2;
  on_root(comm_, [&] {
    publish(temporary_, path_);
    const auto files = checkpoints_in(folder_);
    std::error_code ignored;
    for (size_t i = kept; i < files.size(); ++i) fs::remove(files[i], ignored);
  });
}

}  // namespace windhover::io
