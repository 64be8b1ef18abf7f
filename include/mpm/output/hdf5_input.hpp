#pragma once
/// An HDF5 file that one rank reads by itself.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace mpm::output {

/// Every member function throws FileError for what is not there, cannot be read, or is of another
/// type.
class Hdf5Input {
 public:
  explicit Hdf5Input(std::filesystem::path file);
  ~Hdf5Input();
  Hdf5Input(const Hdf5Input&) = delete;
  Hdf5Input& operator=(const Hdf5Input&) = delete;

  const std::filesystem::path& file() const { return file_; }
  bool has_attribute(const std::string& name) const;      ///< in the root group
  std::int64_t attribute(const std::string& name) const;  ///< of the root group
  std::int64_t rows(const std::string& dataset) const;
  /// `count` rows from `first` on, all components of each.
  template <class T>
  std::vector<T> read_rows(const std::string& dataset, std::int64_t first,
                           std::int64_t count) const;

 private:
  [[noreturn]] void fail(const std::string& action) const;

  std::filesystem::path file_;
  std::int64_t id_;  ///< HDF5's hid_t
};

}  // namespace mpm::output
