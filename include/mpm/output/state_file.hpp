#pragma once
/// The state of a run on all ranks as one HDF5 file, and back.

#include <mpm/core/memory_archive.hpp>

#include <filesystem>

#include <mpi.h>

namespace mpm::output {

/// Every value of all ranks' states, the ranks' parts one after the other below /state, with the
/// length and the checksum of each part. Names and kinds are the same on every rank. The file takes
/// its name when it is complete and on the disk. Collective. Throws FileError on every rank.
void write_state(MPI_Comm comm, const std::filesystem::path& file, const MemoryArchive& state);

/// How many ranks wrote a file. Throws FileError if it is not whole or not of this kind.
int ranks_of_state(const std::filesystem::path& file);

/// This rank's part of a file that as many ranks wrote as there are. Collective. Throws FileError
/// on every rank if the file is not whole or if the checksum of any rank's part is another.
MemoryArchive read_state(MPI_Comm comm, const std::filesystem::path& file);

}  // namespace mpm::output
