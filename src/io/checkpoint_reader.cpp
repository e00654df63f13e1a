#include <type_traits>

#include "base/collective.h"
#include "io/checkpoint.h"
#include "io/checkpoint_files.h"

namespace windhover::io {

CheckpointReader::CheckpointReader(std::filesystem::path path, MPI_Comm comm) : path_(std::move(path)), comm_(comm) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  check(H5Fis_hdf5(path_.c_str()) > 0, "cannot be read, or is no checkpoint");
  const HdfHandle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_mpio(access, comm_, MPI_INFO_NULL);
  file_ = HdfHandle(H5Fopen(path_.c_str(), H5F_ACC_RDONLY, access), H5Fclose);
  check(file_ >= 0, "is cut short or damaged; remove it to continue from the checkpoint before it");
  check(H5Aexists(file_, format_attribute) > 0, "is no checkpoint of this program");
  const auto format = attribute<std::int64_t>(format_attribute);
  check(format == checkpoint_format, fmt::format("has format {}, this program reads {}", format, checkpoint_format));
}

void CheckpointReader::check(bool success, const std::string& problem) const {
  collectively(comm_, [&] {
    if (!success) throw UserError("{}: {}", path_.string(), problem);
  });
}

template <class T>
T CheckpointReader::attribute(const std::string& name) const {
  const HdfHandle attribute(H5Aopen(file_, name.c_str(), H5P_DEFAULT), H5Aclose);
  check(attribute >= 0, fmt::format("has no attribute {}", name));
  const HdfHandle space(H5Aget_space(attribute), H5Sclose), type(H5Aget_type(attribute), H5Tclose);
  T value{};
  bool success = false;
  if constexpr (std::is_same_v<T, std::string>) {
    value.resize(H5Tget_size(type));
    success = H5Tget_class(type) == H5T_STRING && H5Aread(attribute, type, value.data()) >= 0;
    value.resize(value.find('\0') == std::string::npos ? value.size() : value.find('\0'));
  } else if constexpr (std::is_same_v<T, std::vector<double>>) {
    value.resize(size_t(H5Sget_simple_extent_npoints(space)));
    success = H5Aread(attribute, H5T_NATIVE_DOUBLE, value.data()) >= 0;
  } else {
    const hid_t native = std::is_same_v<T, double>         ? H5T_NATIVE_DOUBLE
                         : std::is_same_v<T, std::int64_t> ? H5T_NATIVE_INT64
                                                           : H5T_NATIVE_UINT64;
    success = H5Sget_simple_extent_npoints(space) == 1 && H5Aread(attribute, native, &value) >= 0;
  }
  check(success, fmt::format("attribute {} has another type", name));
  return value;
}

template double CheckpointReader::attribute(const std::string&) const;
template std::int64_t CheckpointReader::attribute(const std::string&) const;
template std::uint64_t CheckpointReader::attribute(const std::string&) const;
template std::string CheckpointReader::attribute(const std::string&) const;
template std::vector<double> CheckpointReader::attribute(const std::string&) const;

bool CheckpointReader::has_array(const std::string& name) const {
  return H5Lexists(file_, name.c_str(), H5P_DEFAULT) > 0;
}

std::int64_t CheckpointReader::rows(const std::string& name) const {
  const HdfHandle data(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  check(data >= 0, fmt::format("has no table {}", name));
  const HdfHandle space(H5Dget_space(data), H5Sclose);
  hsize_t size[2] = {};
  check(H5Sget_simple_extent_ndims(space) == 2 && H5Sget_simple_extent_dims(space, size, nullptr) == 2,
        fmt::format("{} is no table", name));
  return std::int64_t(size[0]);
}

std::vector<double> CheckpointReader::array(const std::string& name, int columns, std::int64_t first,
                                            std::int64_t count) const {
  const HdfHandle data(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  check(data >= 0, fmt::format("has no table {}", name));
  const HdfHandle space(H5Dget_space(data), H5Sclose);
  hsize_t size[2] = {};
  const bool table = H5Sget_simple_extent_ndims(space) == 2 && H5Sget_simple_extent_dims(space, size, nullptr) == 2;
  check(table && size[1] == hsize_t(columns) && std::int64_t(size[0]) >= first + count,
        fmt::format("table {} is {} × {}, expected {} columns and rows up to {}", name, size[0], size[1], columns,
                    first + count));
  const hsize_t offset[2] = {hsize_t(first), 0}, extent[2] = {hsize_t(count), hsize_t(columns)};
  const HdfHandle memory(H5Screate_simple(2, extent, nullptr), H5Sclose);
  const HdfHandle transfer(H5Pcreate(H5P_DATASET_XFER), H5Pclose);
  H5Pset_dxpl_mpio(transfer, H5FD_MPIO_COLLECTIVE);
  H5Sselect_hyperslab(space, H5S_SELECT_SET, offset, nullptr, extent, nullptr);
  std::vector<double> values(size_t(count) * columns);
  check(H5Dread(data, H5T_NATIVE_DOUBLE, memory, space, transfer, values.data()) >= 0,
        fmt::format("table {} cannot be read: the file is damaged", name));
  return values;
}

}  // namespace windhover::io
