#pragma once
/// A picture of the specimen as it was understood.

#include <mpm/micrograph/specimen.hpp>

#include <filesystem>

namespace mpm::micrograph {

/// Writes a PNG with one pixel per location, the top of the specimen in the top row: void black,
/// the first material white, further ones in darker and darker grays. Throws FileError.
void write_preview(const SpecimenModel& model, const std::filesystem::path& file);

}  // namespace mpm::micrograph
