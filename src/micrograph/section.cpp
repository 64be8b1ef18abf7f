#include <mpm/core/error.hpp>
#include <mpm/core/memory.hpp>
#include <mpm/micrograph/grown_walls.hpp>
#include <mpm/micrograph/location_means.hpp>
#include <mpm/micrograph/material_names.hpp>
#include <mpm/micrograph/section.hpp>
#include <mpm/micrograph/threshold.hpp>
#include <mpm/scene/sides.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

namespace mpm::micrograph {

namespace {

using scene::ThresholdRule;

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

/// The cell wall as one band: from the threshold on where walls are bright, else below it.
Band wall_band(double threshold, scene::Wall wall)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (wall == scene::Wall::bright) return {threshold, infinity, 0};
  return {-infinity, threshold, 0};
}

std::int8_t material_of(double gray, std::span<const Band> bands)
{
  for (const Band& band : bands)
    if (gray >= band.from && gray < band.to) return band.material;
  return Lattice<2>::empty;
}

std::vector<std::int8_t> materials_of(std::span<const double> grays, std::span<const Band> bands)
{
  std::vector<std::int8_t> materials(grays.size());
  std::ranges::transform(grays, materials.begin(),
                         [&](double gray) { return material_of(gray, bands); });
  return materials;
}

/// The limit of the locations' mean grays that has the same share below it as `limit` has of the
/// pixels.
double matched(double limit, std::span<const double> pixels, std::span<const double> means,
               const Share& share)
{
  if (std::isinf(limit)) return limit;
  const auto below = std::ranges::count_if(pixels, [limit](double gray) { return gray < limit; });
  return level_with_share_below(means, double(below) / double(pixels.size()), share);
}

/// Throws InputError where a machine has too little for what a part holds while it is filled.
void expect_memory(GlobalIndex locations, const Share& share)
{
  constexpr double bytes_per_location = 16;
  const double bytes = bytes_per_location * double(locations) / share.parts;
  double lacking = bytes > memory_limit();
  share.sum({&lacking, 1});
  if (lacking == 0) return;
  throw InputError(
      fmt::format("grid.cells make {:.3g} locations of particles, which take {} on each rank, and "
                  "there are {} here. Give fewer, or use more ranks on more machines.",
                  double(locations), memory_text(bytes), memory_text(memory_limit())));
}

/// Values of all parts that lie in a band.
double count_in(std::span<const double> grays, std::span<const Band> bands, const Share& share)
{
  auto count = double(std::ranges::count_if(
      grays, [&](double gray) { return material_of(gray, bands) != Lattice<2>::empty; }));
  share.sum(std::span(&count, 1));
  return count;
}

/// The relative density that the scene asks for, if it does.
std::optional<double> aimed_share(const scene::Scene& scene)
{
  const scene::Micrograph& micrograph = *scene.specimen.micrograph;
  if (micrograph.threshold_rule == ThresholdRule::target_relative_density)
    return micrograph.target_relative_density;
  if (micrograph.threshold_rule != ThresholdRule::target_density) return std::nullopt;
  const double wall = scene.materials.front().density();
  if (!(micrograph.target_density < wall))
    throw InputError(
        fmt::format("specimen.threshold.target_density is {:g} kg/m^3, and the cell wall has {:g}. "
                    "Give the density of the whole wood, lumens included, or correct that of the "
                    "material.",
                    micrograph.target_density, wall));
  return micrograph.target_density / wall;
}

[[noreturn]] void fail_without_wall(const scene::Micrograph& micrograph, double threshold,
                                    std::span<const double> means, GlobalIndex locations,
                                    const Share& share)
{
  const double darkest = nth_smallest(means, 0, share);
  const double brightest = nth_smallest(means, locations - 1, share);
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

template <int Dim>
Section<Dim>::Section(const scene::Scene& scene, Picture picture, const IndexVec<Dim>& count,
                      const Share& share)
    : image_(std::move(picture.image)), count_(count)
{
  const scene::Micrograph& micrograph = *scene.specimen.micrograph;
  const IndexBox<Dim> whole{IndexVec<Dim>::Zero(), count};
  Lattice<Dim> held{count, slab(whole, share.part, share.parts), {}, {}};
  expect_memory(whole.size(), share);
  std::vector<double> means = location_means(image_, count, held.part);
  const std::optional<double> aim = aimed_share(scene);
  const bool matches = micrograph.sampling == scene::Sampling::match && !aim;

  std::vector<Band> of_pixels = bands_of(scene);
  const bool by_threshold = of_pixels.empty();
  PieceRules rules{micrograph.remove_specks, micrograph.remove_unconnected};
  for (int d = 0; d < Dim; ++d) rules.periodic[std::size_t(d)] = scene::is_periodic(scene, d);
  if (by_threshold) {
    if (micrograph.threshold_shift == 0) figures_.aim = aim.value_or(0);
    figures_.threshold =
        aim ? threshold_of_density(*aim, micrograph, picture.size, rules, held, means, share)
        : micrograph.threshold_rule == ThresholdRule::otsu ? otsu_threshold(image_.gray)
                                                           : micrograph.threshold;
    figures_.threshold += micrograph.threshold_shift;
    of_pixels = {wall_band(figures_.threshold, micrograph.wall)};
  }
  bands_ = of_pixels;
  for (Band& band : bands_) {
    if (!matches) continue;
    band.from = matched(band.from, image_.gray, means, share);
    band.to = matched(band.to, image_.gray, means, share);
  }
  if (by_threshold)
    figures_.location_threshold =
        micrograph.wall == scene::Wall::bright ? bands_[0].from : bands_[0].to;
  pixel_bands_ = of_pixels;
  figures_.density = count_in(image_.gray, of_pixels, {}) / double(image_.gray.size());

  const double filled = count_in(means, bands_, share);
  if (filled == 0) fail_without_wall(micrograph, figures_.threshold, means, whole.size(), share);
  held.material = materials_of(means, bands_);
  if (rules.remove_something()) remove_pieces(rules, held, filled, share);
  if (rules.only_largest) return;
  for (const Run& run :
       removed_runs(held, {.only_largest = true, .periodic = rules.periodic}, share))
    figures_.unconnected += run.end - run.begin;
}

template <int Dim>
double Section<Dim>::threshold_of_density(double target, const scene::Micrograph& micrograph,
                                          const std::array<double, 2>& size,
                                          const PieceRules& rules, Lattice<Dim>& held,
                                          std::vector<double>& means, const Share& share)
{
  const Parting found = parting_that_leaves(target, rules, micrograph.wall, held, means, share);
  if (std::ranges::min(image_.gray) == std::ranges::max(image_.gray)) return found.threshold;
  // Beyond the gray of the walls or of the lumens a threshold parts noise.
  const GrayClasses classes = gray_classes(image_);
  if (found.threshold > classes.dark && found.threshold < classes.bright &&
      found.missed < density_tolerance)
    return found.threshold;
  if (image_.slices > 1)
    throw InputError(
        fmt::format("specimen.threshold: no gray level between {:.1f} and {:.1f}, which most of "
                    "lumen and wall have, gives a relative density of {:.4g}; the walls of a stack "
                    "are not made thicker or thinner. Give another density, or a threshold.",
                    classes.dark, classes.bright, target));

  const std::array<double, 2> pixel{size[0] / image_.width, size[1] / image_.height};
  GrownWalls grown = grown_walls(image_, classes, micrograph.wall, pixel);
  image_ = std::move(grown.image);
  means = location_means(image_, count_, held.part);
  const double level =
      parting_that_leaves(target, rules, micrograph.wall, held, means, share).threshold;
  figures_.growth =
      grown.growth(level + micrograph.threshold_shift) * std::sqrt(pixel[0] * pixel[1]);
  return level;
}

template <int Dim>
typename Section<Dim>::Parting Section<Dim>::parting_that_leaves(
    double target, const PieceRules& rules, scene::Wall wall, Lattice<Dim>& held,
    std::span<const double> means, const Share& share) const
{
  const double locations = double(IndexBox<Dim>{IndexVec<Dim>::Zero(), count_}.size());
  const double enough = std::max(0.5 / locations, 1e-6);
  // More wall leaves more of it: pieces only grow together.
  double lower = target, upper = 1, least_missing = std::numeric_limits<double>::infinity();
  Parting best{};
  int steps = 0;
  for (double parted = target;;) {
    const double threshold = threshold_for_density(means, parted, wall, share);
    const Band band = wall_band(threshold, wall);
    const double filled = count_in(means, {&band, 1}, share);
    double left = filled;
    if (rules.remove_something()) {
      held.material = materials_of(means, {&band, 1});
      for (const Run& run : removed_runs(held, rules, share)) left -= double(run.end - run.begin);
    }
    const double missing = target - left / locations;
    if (std::abs(missing) < least_missing) {
      least_missing = std::abs(missing);
      best = {threshold, std::abs(filled / locations - parted) - 0.5 / locations};
    }
    if (!rules.remove_something() || least_missing <= enough) break;
    (missing > 0 ? lower : upper) = parted;
    if (upper - lower <= enough) break;
    // What is missing is to be added, most often; where a piece comes or goes, halves find it.
    parted += missing;
    if (!(parted > lower && parted < upper && ++steps % 2 == 1)) parted = 0.5 * (lower + upper);
  }
  return best;
}

template <int Dim>
void Section<Dim>::remove_pieces(const PieceRules& rules, Lattice<Dim>& held, double filled,
                                 const Share& share)
{
  removed_ = removed_runs(held, rules, share);
  for (const Run& run : removed_) figures_.removed += run.end - run.begin;
  if (double(figures_.removed) == filled)
    throw InputError(
        fmt::format("no cell wall left: every piece has fewer than specimen.remove_specks = {} "
                    "locations. Lower it.",
                    rules.fewest_locations));
  leave_out_removed(held.part, held.material);
}

template <int Dim>
std::vector<std::int8_t> Section<Dim>::materials(const IndexBox<Dim>& part) const
{
  std::vector<std::int8_t> materials = materials_of(location_means(image_, count_, part), bands_);
  leave_out_removed(part, materials);
  return materials;
}

template <int Dim>
std::vector<double> Section<Dim>::wall_levels() const
{
  std::vector<double> levels = image_.gray;
  const bool by_threshold = figures_.threshold != 0;
  for (double& level : levels)
    if (!by_threshold)
      level = material_of(level, pixel_bands_) != Lattice<2>::empty;
    else if (pixel_bands_[0].to == figures_.threshold)
      level = -level;
  return levels;
}

template <int Dim>
void Section<Dim>::leave_out_removed(const IndexBox<Dim>& part,
                                     std::vector<std::int8_t>& materials) const
{
  if (removed_.empty() || part.empty()) return;
  const LocalIndex width = part.count()[0];
  const Lattice<Dim> numbers{count_, part, {}, {}};
  IndexBox<Dim> rows = part;
  rows.upper[0] = rows.lower[0] + 1;
  auto first = materials.begin();
  for_each_index(rows, [&](const IndexVec<Dim>& at) {
    const GlobalIndex row = numbers.id(at) / count_[0];
    for (auto run = std::ranges::lower_bound(removed_, row, {}, &Run::row);
         run != removed_.end() && run->row == row; ++run) {
      const LocalIndex begin = std::max(run->begin, part.lower[0]) - part.lower[0];
      const LocalIndex end = std::min(run->end, part.upper[0]) - part.lower[0];
      if (begin < end) std::fill(first + begin, first + end, Lattice<Dim>::empty);
    }
    first += width;
  });
}

template class Section<2>;
template class Section<3>;

}  // namespace mpm::micrograph
