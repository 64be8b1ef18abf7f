#pragma once
/// A new HDF5 file written by all ranks together; every call to the HDF5 library is behind this.

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <span>
#include <string>

#include <mpi.h>

namespace mpm::output {

enum class Compression { none, gzip };  ///< gzip: half the size, three to four times the time

/// Exists under a temporary name until finish(). Every member function is collective; if any rank
/// fails, every rank throws the same FileError.
class Hdf5File {
 public:
  /// Room for the bytes expected is reserved on the disk first: MPI's own layer may lose a write to
  /// a full disk without a word, or wait for ever.
  Hdf5File(MPI_Comm comm, std::filesystem::path file, Compression compression,
           std::int64_t expected_bytes);
  ~Hdf5File();  ///< A file that was not finished is removed.
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;

  void create_group(const std::string& name);

  /// The ranks' rows one after the other in rank order; a scalar column has one component. Groups
  /// on the way to it are made.
  void write_rows(const std::string& dataset, const std::string& unit, int components,
                  std::span<const double> values);
  void write_rows(const std::string& dataset, const std::string& unit, int components,
                  std::span<const std::int64_t> values);
  void write_rows(const std::string& dataset, const std::string& unit, int components,
                  std::span<const std::int32_t> values);

  void write_rows(const std::string& dataset, const std::string& unit, int components,
                  std::span<const std::uint8_t> values);

  /// On the root group; the value of rank 0.
  void set_attribute(const std::string& name, double value);
  void set_attribute(const std::string& name, std::int64_t value);

  /// Marks the file complete, closes it, syncs it to the disk and gives it its name.
  void finish();

 private:
  using Identifier = std::int64_t;  ///< HDF5's hid_t

  template <class T>
  void write(const std::string& dataset, const std::string& unit, int components,
             std::span<const T> values);
  void set_root_attribute(const std::string& name, Identifier type, const void* value);
  void agree(const std::string& problem) const;
  void give_up(std::initializer_list<std::filesystem::path> names) const;

  MPI_Comm comm_;
  std::filesystem::path file_;
  std::filesystem::path temporary_;
  Compression compression_;
  Identifier id_ = -1;
  bool finished_ = false;
};

}  // namespace mpm::output
