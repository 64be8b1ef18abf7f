#include <mpm/core/error.hpp>
#include <mpm/micrograph/lattice.hpp>
#include <mpm/micrograph/location_means.hpp>
#include <mpm/micrograph/material_names.hpp>
#include <mpm/micrograph/threshold.hpp>

#include <algorithm>

#include <fmt/format.h>

namespace mpm::micrograph {

namespace {

/// A gray band with its material looked up.
struct Band {
  double from, to;
  std::int8_t material;
};

std::vector<Band> bands_of(const scene::Scene& scene)
{
  const MaterialNames materials(scene.materials);
  std::vector<Band> bands;
  for (const scene::GrayBand& band : scene.specimen.micrograph->bands) {
    const std::string key = fmt::format("specimen.bands[{}]", bands.size());
    if (!(band.from < band.to))
      throw InputError(
          fmt::format("{} is from {} to {} (from must be below to).", key, band.from, band.to));
    for (std::size_t other = 0; other < bands.size(); ++other)
      if (band.from < bands[other].to && bands[other].from < band.to)
        throw InputError(
            fmt::format("{} from {} to {} overlaps specimen.bands[{}] from {} to {}. Part them.",
                        key, band.from, band.to, other, bands[other].from, bands[other].to));
    bands.push_back({band.from, band.to, materials.index(band.material, key + ".material")});
  }
  return bands;
}

double threshold_of(const scene::Micrograph& micrograph, const GrayImage& image,
                    const std::vector<double>& means)
{
  switch (micrograph.threshold_rule) {
    case scene::ThresholdRule::otsu:
      return otsu_threshold(image.gray);
    case scene::ThresholdRule::target_relative_density:
      return threshold_for_density(means, micrograph.target_relative_density, micrograph.wall);
    case scene::ThresholdRule::value:
      break;
  }
  return micrograph.threshold;
}

[[noreturn]] void fail_without_wall(const scene::Micrograph& micrograph, double threshold,
                                    const std::vector<double>& means)
{
  const auto [darkest, brightest] = std::ranges::minmax(means);
  const std::string range =
      fmt::format("the gray of the locations lies between {:.1f} and {:.1f}", darkest, brightest);
  if (!micrograph.bands.empty())
    throw InputError(fmt::format(
        "no cell wall found: {}, outside every entry of specimen.bands. Change their limits.",
        range));
  const bool bright = micrograph.wall == scene::Wall::bright;
  throw InputError(fmt::format(
      "no cell wall found: {}, specimen.threshold is {:.1f} and walls are {}. {} the threshold, or "
      "set specimen.wall: {}.",
      range, threshold, bright ? "bright" : "dark", bright ? "Lower" : "Raise",
      bright ? "dark" : "bright"));
}

}  // namespace

double fill_with_image(Lattice& lattice, const scene::Scene& scene, const GrayImage& image)
{
  const scene::Micrograph& micrograph = *scene.specimen.micrograph;
  const std::vector<double> means = location_means(image, lattice.nx, lattice.ny);
  const std::vector<Band> bands = bands_of(scene);
  double threshold = 0;
  if (bands.empty()) {
    threshold = threshold_of(micrograph, image, means);
    std::ranges::transform(means, lattice.material.begin(), [&](double mean) {
      return is_wall(mean, threshold, micrograph.wall) ? std::int8_t(0) : Lattice::empty;
    });
  } else {
    std::ranges::transform(means, lattice.material.begin(), [&](double mean) {
      const auto band = std::ranges::find_if(
          bands, [mean](const Band& b) { return mean >= b.from && mean < b.to; });
      return band == bands.end() ? Lattice::empty : band->material;
    });
  }
  if (std::ranges::all_of(lattice.material, [](auto m) { return m == Lattice::empty; }))
    fail_without_wall(micrograph, threshold, means);
  return threshold;
}

}  // namespace mpm::micrograph
