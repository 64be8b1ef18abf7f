#include <mpm/core/error.hpp>
#include <mpm/micrograph/image.hpp>
#include <mpm/micrograph/lattice.hpp>
#include <mpm/micrograph/pieces.hpp>
#include <mpm/micrograph/specimen.hpp>

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace mpm::micrograph {

namespace {

using Size = std::array<double, 2>;

// Tags that make a pixel larger than this (m) are a screen's or printer's, not a microscope's:
// 96 dots per inch are 265 um, and cell walls are 2 to 10 um thick.
constexpr double largest_tagged_pixel = 20e-6;

/// Width and height in m of the image as stored: from the scene, else from the file's resolution
/// tags.
Size whole_size(const scene::Micrograph& micrograph, const GrayImage& image)
{
  if (micrograph.image_size && micrograph.pixel_size)
    throw InputError(
        "specimen.image_size and specimen.pixel_size are both given. Give one of them.");
  const std::string remedy = "Give specimen.image_size or specimen.pixel_size.";
  Size size{};
  if (micrograph.image_size) {
    size = *micrograph.image_size;
  } else {
    const auto pixel = micrograph.pixel_size ? micrograph.pixel_size : image.pixel_size;
    if (!pixel)
      throw InputError(fmt::format("{}: the size of the image is unknown. {}",
                                   micrograph.file.string(), remedy));
    if (!micrograph.pixel_size && std::ranges::max(*pixel) > largest_tagged_pixel)
      throw InputError(
          fmt::format("{}: its resolution tags make a pixel {:.4g} um wide, which is a "
                      "screen's or printer's, not a microscope's. {}",
                      micrograph.file.string(), (*pixel)[0] * 1e6, remedy));
    size = {(*pixel)[0] * image.width, (*pixel)[1] * image.height};
  }
  if (!(size[0] > 0 && size[1] > 0))
    throw InputError(fmt::format("{}: the image is {} x {} m (must be above 0). {}",
                                 micrograph.file.string(), size[0], size[1], remedy));
  return size;
}

struct SizedImage {
  GrayImage image;
  Size size;  // m
};

/// The part of the micrograph that becomes the specimen, upright.
SizedImage specimen_image(const scene::Micrograph& micrograph)
{
  GrayImage image = read_image(micrograph.file);
  Size size = whole_size(micrograph, image);
  if (micrograph.crop) {
    const double whole_width = image.width, whole_height = image.height;
    image = cropped(image, *micrograph.crop);
    size = {size[0] * (image.width / whole_width), size[1] * (image.height / whole_height)};
  }
  image = turned(image, micrograph.rotate);
  if (micrograph.rotate % 180 != 0) std::swap(size[0], size[1]);
  if (micrograph.flip_horizontal) image = mirrored(image);
  if (micrograph.flip_vertical) image = upended(image);
  return {std::move(image), size};
}

/// Removes what the scene wants removed; returns the number of locations.
std::int64_t clean(Lattice& lattice, const scene::Micrograph& micrograph)
{
  std::int64_t removed = 0;
  if (micrograph.remove_specks > 1) removed += remove_specks(lattice, micrograph.remove_specks);
  if (std::ranges::all_of(lattice.material, [](auto m) { return m == Lattice::empty; }))
    throw InputError(
        fmt::format("no cell wall left: every piece has fewer than specimen.remove_specks = {} "
                    "locations. Lower "
                    "it.",
                    micrograph.remove_specks));
  if (micrograph.remove_unconnected) removed += keep_largest_piece(lattice);
  return removed;
}

SpecimenModel model_of(const scene::Scene& scene)
{
  const scene::Specimen& specimen = scene.specimen;
  if (specimen.micrograph && !specimen.shapes.empty())
    throw InputError("specimen.micrograph and specimen.shapes are both given. Give one of them.");
  if (!specimen.micrograph && specimen.shapes.empty())
    throw InputError("specimen is empty. Give specimen.micrograph, or specimen.size and .shapes.");

  SpecimenModel model{};
  model.particles_per_cell = scene.grid.particles_per_cell;
  const auto lay_lattice = [&](const Size& size) {
    model.size = size;
    model.cells = cell_counts(scene.grid, size);
    model.lattice = empty_lattice(model.cells, model.particles_per_cell);
  };
  if (specimen.micrograph) {
    const auto [image, size] = specimen_image(*specimen.micrograph);
    lay_lattice(size);
    model.threshold = fill_with_image(model.lattice, scene, image);
    model.removed = clean(model.lattice, *specimen.micrograph);
  } else {
    for (std::size_t d = 0; d < 2; ++d)
      if (!(specimen.size[d] > 0))
        throw InputError(
            fmt::format("specimen.size[{}] is {} m (must be above 0).", d, specimen.size[d]));
    lay_lattice(specimen.size);
    fill_with_shapes(model.lattice, scene);
    if (model.particles() == 0)
      throw InputError(
          "no location is filled: specimen.shapes cut out all they fill. Change them.");
  }
  model.densities = densities(model.lattice, scene);
  return model;
}

}  // namespace

std::int64_t SpecimenModel::particles() const
{
  return std::ranges::count_if(lattice.material, [](auto m) { return m != Lattice::empty; });
}

SpecimenModel build_specimen(const scene::Scene& scene)
{
  try {
    return model_of(scene);
  } catch (const InputError& error) {
    if (scene.file.empty()) throw;
    throw InputError(scene.file.string() + ": " + error.what());
  }
}

}  // namespace mpm::micrograph
