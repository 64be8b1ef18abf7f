#include <mpm/core/error.hpp>
#include <mpm/output/hdf5_input.hpp>

#include <array>

#include "hdf5_handles.hpp"
#include <fmt/core.h>

namespace mpm::output {

Hdf5Input::Hdf5Input(std::filesystem::path file) : file_(std::move(file))
{
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // its messages go into FileError instead
  std::error_code ignored;
  if (!std::filesystem::exists(file_, ignored))
    throw FileError(file_.string() + ": there is no such file.");
  if (H5Fis_hdf5(file_.c_str()) == 0)
    throw FileError(file_.string() + ": is no HDF5 file, or one that was cut off.");
  id_ = H5Fopen(file_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (id_ < 0) fail("open the file");
}

Hdf5Input::~Hdf5Input()
{
  if (id_ >= 0) H5Fclose(id_);
}

bool Hdf5Input::has_attribute(const std::string& name) const
{
  return H5Aexists(id_, name.c_str()) > 0;
}

std::int64_t Hdf5Input::attribute(const std::string& name) const
{
  const Handle attribute(H5Aopen(id_, name.c_str(), H5P_DEFAULT), H5Aclose);
  std::int64_t value = 0;
  if (attribute < 0 || H5Aread(attribute, H5T_NATIVE_INT64, &value) < 0)
    fail("read attribute " + name);
  return value;
}

std::int64_t Hdf5Input::rows(const std::string& dataset) const
{
  const Handle source(H5Dopen2(id_, dataset.c_str(), H5P_DEFAULT), H5Dclose);
  if (source < 0) fail("open dataset " + dataset);
  const Handle space(H5Dget_space(source), H5Sclose);
  std::array<hsize_t, 2> size{};
  const int dimensions = H5Sget_simple_extent_ndims(space);
  if (dimensions < 1 || dimensions > 2 ||
      H5Sget_simple_extent_dims(space, size.data(), nullptr) < 0)
    fail("read the size of dataset " + dataset);
  return std::int64_t(size[0]);
}

template <class T>
std::vector<T> Hdf5Input::read_rows(const std::string& dataset, std::int64_t first,
                                    std::int64_t count) const
{
  const Handle source(H5Dopen2(id_, dataset.c_str(), H5P_DEFAULT), H5Dclose);
  if (source < 0) fail("open dataset " + dataset);
  const Handle space(H5Dget_space(source), H5Sclose), stored(H5Dget_type(source), H5Tclose);
  std::array<hsize_t, 2> size{0, 1};
  const int dimensions = H5Sget_simple_extent_ndims(space);
  if (dimensions < 1 || dimensions > 2 ||
      H5Sget_simple_extent_dims(space, size.data(), nullptr) < 0 ||
      H5Tget_class(stored) != H5Tget_class(native_type<T>()) || H5Tget_size(stored) != sizeof(T) ||
      first < 0 || count < 0 || hsize_t(first + count) > size[0])
    fail("find so many values in dataset " + dataset);
  std::vector<T> values(std::size_t(count) * size[1]);
  if (count == 0) return values;
  const std::array<hsize_t, 2> start{hsize_t(first), 0}, part{hsize_t(count), size[1]};
  const Handle memory(H5Screate_simple(dimensions, part.data(), nullptr), H5Sclose);
  H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, part.data(), nullptr);
  if (H5Dread(source, native_type<T>(), memory, space, H5P_DEFAULT, values.data()) < 0)
    fail("read dataset " + dataset);
  return values;
}

template std::vector<double> Hdf5Input::read_rows(const std::string&, std::int64_t,
                                                  std::int64_t) const;
template std::vector<std::int64_t> Hdf5Input::read_rows(const std::string&, std::int64_t,
                                                        std::int64_t) const;
template std::vector<std::uint8_t> Hdf5Input::read_rows(const std::string&, std::int64_t,
                                                        std::int64_t) const;

void Hdf5Input::fail(const std::string& action) const
{
  throw FileError(fmt::format("{}: cannot {} ({}).", file_.string(), action, last_hdf5_message()));
}

}  // namespace mpm::output
