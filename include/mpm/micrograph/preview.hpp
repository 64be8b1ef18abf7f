#pragma once
/// A picture of the specimen as it was understood.

#include <mpm/micrograph/specimen.hpp>

#include <filesystem>

namespace mpm::micrograph {

/// Writes a PNG with one pixel per location, the top of the specimen in the top row: void black,
/// the first material white, further ones in darker and darker grays. In space of the middle layer
/// across z. Of a lattice that is longer than `most_pixels` every second, third, ... location is
/// shown. Holds one row at a time. Throws FileError.
template <int Dim>
void write_preview(const Specimen<Dim>& specimen, const std::filesystem::path& file,
                   int most_pixels = 4096);

}  // namespace mpm::micrograph
