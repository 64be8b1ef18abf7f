#include <mpm/core/error.hpp>
#include <mpm/micrograph/wall_thickness.hpp>
#include <mpm/simulation/failure_cause.hpp>
#include <mpm/simulation/method.hpp>

#include <fmt/format.h>

namespace mpm {

namespace {

/// Whether the wall was thinner than two cells where the particle stood at the start.
template <int Dim>
bool was_thin(const Preparation<Dim>& preparation, GlobalIndex particle)
{
  const auto& specimen = preparation.specimen;
  // Particles of the load cell are numbered behind the locations.
  if (particle < 0 || particle >= specimen.locations()) return false;
  IndexBox<Dim> place;
  for (int d = 0; d < Dim; ++d) {
    place.lower[d] = LocalIndex(particle % specimen.count()[d]);
    place.upper[d] = place.lower[d] + 1;
    particle /= specimen.count()[d];
  }
  return micrograph::count_thin(specimen, std::span(preparation.scene.materials), place,
                                micrograph::thin_wall_cells)
             .thin > 0;
}

}  // namespace

template <int Dim>
std::string likely_cause(const Preparation<Dim>& preparation, GlobalIndex particle)
{
  const scene::Numerics& numerics = preparation.scene.numerics;
  const Layout<Dim>& layout = preparation.layout;
  const auto limit = stable_cfl_of(numerics);
  if (limit && layout.cfl > *limit)
    return fmt::format(
        " Likely cause: numerics.cfl is {:.3g}, beyond {:.3g}, the limit of {}. Leave it out: the "
        "default keeps a margin.",
        layout.cfl, *limit, limited_by(numerics));
  if (layout.largest_speed > layout.wave_speed)
    return fmt::format(
        " Likely cause: {:.3g} m/s is faster than the fastest wave, {:.3g} m/s. Lower the speed.",
        layout.largest_speed, layout.wave_speed);
  if (is_total_lagrangian(numerics)) return "";
  if (was_thin(preparation, particle))
    return " Likely cause: the wall is thinner than two cells where this particle was at the "
           "start. Refine grid.cells.";
  if (std::holds_alternative<scene::FreeMotion>(preparation.scene.motion) &&
      reaction_book(numerics) == ReactionBook::increments)
    return fmt::format(
        " Likely cause: noise of particles that cross cells, which {} keeps and which grows in "
        "free "
        "flight and rotation. Take gimp or quadratic with scheme apic or tpic.",
        numerics.scheme->keyword);
  return "";
}

template std::string likely_cause(const Preparation<2>&, GlobalIndex);
template std::string likely_cause(const Preparation<3>&, GlobalIndex);

}  // namespace mpm
