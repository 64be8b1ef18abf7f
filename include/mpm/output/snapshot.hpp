#pragma once
/// A picture of all particles at one moment, written collectively by all ranks.

#include <mpm/core/archive.hpp>
#include <mpm/output/xdmf.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include <mpi.h>

namespace mpm::output {

/// One field of this rank's particles, `components` values per particle.
struct ParticleField {
  std::string name;    ///< as in ParaView and in the file
  std::string unit;    ///< UDUNITS spelling; "1" if none
  int components = 1;  ///< 1 scalar, 3 vector (z = 0 in 2D), 6 symmetric tensor XX YY ZZ XY YZ XZ
  std::variant<std::vector<double>, std::vector<std::int64_t>, std::vector<std::int32_t>> values;
};

struct Snapshot {
  double time = 0;    ///< s
  double strain = 0;  ///< 0 without a piston
  std::int64_t step = 0;
  double particle_volume = 0;         ///< m3, of a location at the start
  std::vector<double> position;       ///< m, 3 per particle (z = 0 in 2D)
  std::vector<ParticleField> fields;  ///< the same names in the same order on every rank
};

/// One HDF5 file per snapshot (temporary name, closed, synced, renamed: a kill never harms what was
/// written before) and one XDMF file of the series, valid at every moment. A
/// snapshot without particles has its file but no place in the series.
class SnapshotSeries {
 public:
  struct Options {
    bool compress = false;
  };
  /// Writes DIR/snapshots/000000.h5, ... and DIR/<name>.xdmf; made, it touches nothing yet.
  SnapshotSeries(MPI_Comm comm, std::filesystem::path directory, std::string name, Options options);

  /// A series of that name from an earlier run is taken down, since its files are about to be
  /// replaced; one that goes on names what is still there of it. Collective. Throws FileError on
  /// every rank if its list cannot be written.
  void begin();
  /// Collective. Throws FileError on every rank if any rank could not write.
  void write(const Snapshot& snapshot);

  int written() const { return written_; }
  /// Takes down all but the first ones. Collective.
  void cut(int written);
  /// What has been written.
  void archive(Archive& archive);

 private:
  void write_list() const;

  MPI_Comm comm_;
  std::filesystem::path directory_;
  std::string name_;
  Options options_;
  int written_ = 0;
  std::vector<XdmfGrid> entries_;  ///< of the snapshots with any particle, there or not
};

}  // namespace mpm::output
