#pragma once
/// Cells whose corners stand on the surface of what the scene describes.

#include <mpm/core/corner_offsets.hpp>
#include <mpm/core/index_box.hpp>
#include <mpm/simulation/layout.hpp>

namespace mpm {

/// Offsets of the corners of a part of the specimen's locations; none where the scene asks for
/// stairs, and in space. Not collective.
template <int Dim>
CornerOffsets<Dim> surface_offsets(const scene::Scene& scene,
                                   const micrograph::Specimen<Dim>& specimen,
                                   const Layout<Dim>& layout, const IndexBox<Dim>& part);

}  // namespace mpm
