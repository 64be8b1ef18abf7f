#include <mpm/core/error.hpp>
#include <mpm/core/terminal.hpp>
#include <mpm/output/hdf5_file.hpp>
#include <mpm/output/replace_file.hpp>
#include <mpm/parallel/open_files.hpp>
#include <mpm/parallel/session.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <random>
#include <string_view>
#include <system_error>
#include <type_traits>

#include "hdf5_handles.hpp"
#include <fmt/core.h>

namespace mpm::output {

namespace {

constexpr hsize_t chunk_rows = 65536;  ///< 0.5 MB a column: large enough for gzip to be worth it

/// The same bytes whatever machine wrote them.
template <class T>
hid_t stored_type()
{
  if constexpr (std::is_same_v<T, double>) return H5T_IEEE_F64LE;
  if constexpr (std::is_same_v<T, std::int64_t>) return H5T_STD_I64LE;
  if constexpr (std::is_same_v<T, std::int32_t>) return H5T_STD_I32LE;
  if constexpr (std::is_same_v<T, std::uint8_t>) return H5T_STD_U8LE;
}

bool attach(hid_t object, const std::string& name, hid_t type, const void* value)
{
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose);
  return attribute >= 0 && H5Awrite(attribute, type, value) >= 0;
}

bool attach(hid_t object, const std::string& name, const std::string& text)
{
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, std::max<std::size_t>(text.size(), 1));
  H5Tset_cset(type, H5T_CSET_UTF8);
  return attach(object, name, type, text.c_str());
}

std::filesystem::path file_in_writing;  // for those who have to say that it failed

/// A rank whose write fails in the middle of a collective one leaves the others waiting for it for
/// ever, in MPI (Open MPI 4: io/ompio) or in HDF5's own messages, and HDF5 1.10 crashes when it
/// ends with a file that cannot be closed. So the rank that sees the failure says so and ends all.
[[noreturn]] void end_all_ranks(const char* what, int error)
{
  char words[MPI_MAX_ERROR_STRING] = "fewer bytes than asked for";
  int length = 0;
  if (error != MPI_SUCCESS) MPI_Error_string(error, words, &length);
  const int rank = rank_of(MPI_COMM_WORLD);
  std::error_code ignored;
  std::filesystem::remove(temporary_name(file_in_writing), ignored);
  print_message(fmt::format("{}: {} failed{} ({}). Check free space, quota and disk.",
                            file_in_writing.string(), what,
                            rank > 0 ? fmt::format(" on rank {}", rank) : "", words));
  end_with_open_files();
}

int expect_good(const char* what, int error)
{
  if (error != MPI_SUCCESS && !file_in_writing.empty()) end_all_ranks(what, error);
  return error;
}

int expect_whole(int error, int count, MPI_Datatype type, const MPI_Status* status)
{
  expect_good("writing", error);
  if (file_in_writing.empty() || status == MPI_STATUS_IGNORE) return error;
  MPI_Count asked = 0, done = 0;
  MPI_Type_size_x(type, &asked);
  MPI_Get_elements_x(status, MPI_BYTE, &done);
  if (done < asked * count) end_all_ranks("writing", MPI_SUCCESS);
  return error;
}

/// The name beside it that nobody else uses, on every rank.
std::filesystem::path name_of_its_own(MPI_Comm comm, const std::filesystem::path& file)
{
  std::uint64_t number = 0;
  if (rank_of(comm) == 0) {
    std::random_device random;
    number = (std::uint64_t(random()) << 32) | random();
  }
  MPI_Bcast(&number, 1, MPI_UINT64_T, 0, comm);
  return temporary_name(file.parent_path() / fmt::format("{}.{:016x}{}", file.stem().string(),
                                                         number, file.extension().string()));
}

}  // namespace

Hdf5File::Hdf5File(MPI_Comm comm, std::filesystem::path file, Compression compression,
                   std::int64_t expected_bytes)
    : comm_(comm),
      file_(std::move(file)),
      temporary_(temporary_name(file_)),
      compression_(compression)
{
  on_rank_zero(comm_, [&] { reserve_room(temporary_, expected_bytes); });
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // its messages go into FileError instead
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_mpio(access, comm_, MPI_INFO_NULL);
  H5Pset_all_coll_metadata_ops(access, true);
  H5Pset_coll_metadata_write(access, true);
  // While it opens a file, Open MPI (4 and 5: sharedfp/sm) holds a semaphore of the machine with
  // the file's last name. One that a killed run left behind stops every later run there for ever,
  // and one of another user cannot be opened.
  const std::filesystem::path opened = name_of_its_own(comm_, file_);
  id_ = H5Fcreate(opened.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
  try {
    agree(id_ < 0 ? "create the file" : "");
    file_in_writing = file_;
    on_rank_zero(comm_, [&] {
      give_name(opened, temporary_);
      reserve_room(temporary_, expected_bytes);
    });
  } catch (const FileError&) {
    give_up({opened, temporary_});
    throw;
  }
}

Hdf5File::~Hdf5File()
{
  if (!finished_) give_up({temporary_});
}

void Hdf5File::give_up(std::initializer_list<std::filesystem::path> names) const
{
  // A file that cannot be written cannot be closed either, and HDF5 1.10 crashes when it ends after
  // a failed close. What it holds is given back here, its name first.
  if (id_ >= 0) leave_files_open();
  if (rank_of(comm_) > 0) return;
  std::error_code ignored;
  for (const std::filesystem::path& name : names) {
    std::filesystem::resize_file(name, 0, ignored);
    std::filesystem::remove(name, ignored);
  }
}

void Hdf5File::create_group(const std::string& name)
{
  const Handle group(H5Gcreate2(id_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                     H5Gclose);
  agree(group < 0 ? "create group " + name : "");
}

template <class T>
void Hdf5File::write(const std::string& dataset, const std::string& unit, int components,
                     std::span<const T> values)
{
  MPM_ASSERT(values.size() % std::size_t(components) == 0);
  const std::int64_t mine = std::int64_t(values.size()) / components;
  std::int64_t before = 0;  // MPI_Exscan leaves rank 0's result alone
  std::int64_t all = 0;
  MPI_Exscan(&mine, &before, 1, MPI_INT64_T, MPI_SUM, comm_);
  MPI_Allreduce(&mine, &all, 1, MPI_INT64_T, MPI_SUM, comm_);

  const int rank = components == 1 ? 1 : 2;
  const std::array<hsize_t, 2> total{hsize_t(all), hsize_t(components)};
  const std::array<hsize_t, 2> local{hsize_t(mine), hsize_t(components)};
  const std::array<hsize_t, 2> start{hsize_t(before), 0};
  const Handle file_space(H5Screate_simple(rank, total.data(), nullptr), H5Sclose);
  const Handle memory_space(H5Screate_simple(rank, local.data(), nullptr), H5Sclose);
  if (mine > 0)
    H5Sselect_hyperslab(file_space, H5S_SELECT_SET, start.data(), nullptr, local.data(), nullptr);
  else  // takes part in the collective write all the same
    (H5Sselect_none(file_space), H5Sselect_none(memory_space));

  const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_fill_time(creation, H5D_FILL_TIME_NEVER);
  H5Pset_obj_track_times(creation, false);  // equal runs write equal files
  if (compression_ == Compression::gzip && all > 0) {
    const std::array<hsize_t, 2> chunk{std::min(total[0], chunk_rows), total[1]};
    H5Pset_chunk(creation, rank, chunk.data());
    H5Pset_shuffle(creation);
    H5Pset_deflate(creation, 1);
  }
  const Handle link(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(link, 1);
  const Handle target(
      H5Dcreate2(id_, dataset.c_str(), stored_type<T>(), file_space, link, creation, H5P_DEFAULT),
      H5Dclose);
  agree(target < 0 ? "create dataset " + dataset : "");

  if (all > 0) {  // HDF5 1.10 fails to write no rows to a dataset of none
    const Handle transfer(H5Pcreate(H5P_DATASET_XFER), H5Pclose);
    H5Pset_dxpl_mpio(transfer, H5FD_MPIO_COLLECTIVE);
    const bool written =
        H5Dwrite(target, native_type<T>(), memory_space, file_space, transfer, values.data()) >= 0;
    agree(written ? "" : "write dataset " + dataset);
  }
  agree(attach(target, "unit", unit) ? "" : "write the unit of dataset " + dataset);
}

void Hdf5File::write_rows(const std::string& dataset, const std::string& unit, int components,
                          std::span<const double> values)
{
  write(dataset, unit, components, values);
}

void Hdf5File::write_rows(const std::string& dataset, const std::string& unit, int components,
                          std::span<const std::int64_t> values)
{
  write(dataset, unit, components, values);
}

void Hdf5File::write_rows(const std::string& dataset, const std::string& unit, int components,
                          std::span<const std::int32_t> values)
{
  write(dataset, unit, components, values);
}

void Hdf5File::write_rows(const std::string& dataset, const std::string& unit, int components,
                          std::span<const std::uint8_t> values)
{
  write(dataset, unit, components, values);
}

void Hdf5File::set_attribute(const std::string& name, double value)
{
  MPI_Bcast(&value, 1, MPI_DOUBLE, 0, comm_);
  set_root_attribute(name, H5T_NATIVE_DOUBLE, &value);
}

void Hdf5File::set_attribute(const std::string& name, std::int64_t value)
{
  MPI_Bcast(&value, 1, MPI_INT64_T, 0, comm_);
  set_root_attribute(name, H5T_NATIVE_INT64, &value);
}

void Hdf5File::set_root_attribute(const std::string& name, Identifier type, const void* value)
{
  const bool written = attach(id_, name, type, value);
  agree(written ? "" : "write attribute " + name);
}

void Hdf5File::finish()
{
  set_attribute("complete", std::int64_t{1});
  // Syncs what each rank wrote on its own node; rank 0 below can only sync its own.
  agree(H5Fflush(id_, H5F_SCOPE_GLOBAL) < 0 ? "sync the file" : "");
  agree(H5Fclose(id_) < 0 ? "close the file" : "");
  file_in_writing.clear();
  on_rank_zero(comm_, [this] { rename_when_synced(temporary_, file_); });
  finished_ = true;
}

void Hdf5File::agree(const std::string& problem) const
{
  mpm::agree(comm_, [&] {
    if (!problem.empty())
      throw FileError(fmt::format("{}: cannot {} ({}). Check free space and permissions.",
                                  file_.string(), problem, last_hdf5_message()));
  });
}

}  // namespace mpm::output

// MPI's profiling interface: HDF5's calls come by here. Open MPI 4 tells of a failed write by a
// short count alone, and HDF5 of neither before its ranks wait for each other.
extern "C" {

int MPI_File_write_at(MPI_File file, MPI_Offset at, const void* from, int count, MPI_Datatype type,
                      MPI_Status* status)
{
  const int error = PMPI_File_write_at(file, at, from, count, type, status);
  return mpm::output::expect_whole(error, count, type, status);
}

int MPI_File_write_at_all(MPI_File file, MPI_Offset at, const void* from, int count,
                          MPI_Datatype type, MPI_Status* status)
{
  const int error = PMPI_File_write_at_all(file, at, from, count, type, status);
  return mpm::output::expect_whole(error, count, type, status);
}

int MPI_File_sync(MPI_File file)
{
  return mpm::output::expect_good("syncing", PMPI_File_sync(file));
}

int MPI_File_set_size(MPI_File file, MPI_Offset size)
{
  return mpm::output::expect_good("sizing", PMPI_File_set_size(file, size));
}

}  // extern "C"
