#pragma once
/// The XDMF file through which ParaView finds the arrays of a series of HDF5 files.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace mpm::output {

enum class NumberType { float64, int64, int32 };

struct XdmfArray {
  std::string name;
  std::string unit;
  int components = 1;  ///< 1, 3 or 6
  NumberType type = NumberType::float64;
};

/// The particles at one moment: arrays below /particles of FILE, named relative to the XDMF file.
struct XdmfGrid {
  std::string file;
  double time = 0;  ///< s
  double strain = 0;
  std::int64_t particles = 0;
  NumberType connectivity = NumberType::int32;
  std::vector<XdmfArray> arrays;
};

/// Replaces FILE whole. Every file named must exist: ParaView aborts on one that does not.
/// Throws FileError.
void write_xdmf(const std::filesystem::path& file, const std::string& name,
                const std::vector<XdmfGrid>& grids);

}  // namespace mpm::output
