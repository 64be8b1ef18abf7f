#include <mpm/core/error.hpp>
#include <mpm/micrograph/anatomy_drawing.hpp>
#include <mpm/micrograph/image_formats.hpp>
#include <mpm/micrograph/picture.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace mpm::micrograph {

namespace {

// Tags that make a pixel larger than this (m) are a screen's or printer's, not a microscope's:
// 96 dots per inch are 265 um, and cell walls are 2 to 10 um thick.
constexpr double largest_tagged_pixel = 20e-6;

/// Width and height in m of the image as stored: from the scene, else from the file's resolution
/// tags.
std::array<double, 2> whole_size(const scene::Micrograph& micrograph, const GrayImage& image)
{
  if (micrograph.image_size && micrograph.pixel_size)
    throw InputError(
        "specimen.image_size and specimen.pixel_size are both given. Give one of them.");
  const std::string remedy = "Give specimen.image_size or specimen.pixel_size.";
  std::array<double, 2> size{};
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

/// In space of wood whose cells end a stack, its slices as thick as a pixel is wide.
GrayImage drawn_image(const scene::Micrograph& micrograph)
{
  const anatomy::Parameters wood = anatomy::read_parameters(micrograph.file);
  const std::uint64_t seed = micrograph.seed ? std::uint64_t(*micrograph.seed) : wood.seed;
  GrayImage image{wood.picture.width_px, wood.picture.height_px, {}, {}, 1};
  const auto pixel = [](double micrometres, int pixels) { return micrometres * 1e-6 / pixels; };
  image.pixel_size = {pixel(wood.picture.width, image.width),
                      pixel(wood.picture.height, image.height)};
  std::vector<std::uint8_t> gray;
  if (wood.grain && micrograph.depth) {
    const double slices = std::max(1.0, std::round(*micrograph.depth / (*image.pixel_size)[0]));
    check_dimensions(image.width, image.height, std::int64_t(std::min(slices, 1e9)));
    image.slices = int(slices);
    gray = anatomy::draw_slices(wood, seed, *micrograph.depth * 1e6, image.slices);
  } else {
    gray = anatomy::draw(wood, seed).gray;
  }
  image.gray.assign(gray.begin(), gray.end());
  return image;
}

GrayImage upright(const scene::Micrograph& micrograph, const GrayImage& slice)
{
  GrayImage image = micrograph.crop ? cropped(slice, *micrograph.crop) : slice;
  image = turned(image, micrograph.rotate);
  if (micrograph.flip_horizontal) image = mirrored(image);
  if (micrograph.flip_vertical) image = upended(image);
  return image;
}

Picture specimen_picture(const scene::Micrograph& micrograph)
{
  GrayImage image = micrograph.is_drawn() ? drawn_image(micrograph) : read_image(micrograph.file);
  if (image.slices > 1 && !micrograph.depth)
    throw InputError(
        fmt::format("{}: is a stack of {} slices, and the scene lies in the plane. Give "
                    "specimen.depth, the thickness of all of them, or save the one slice to be "
                    "modelled as a file of its own.",
                    micrograph.file.string(), image.slices));
  std::array<double, 2> size = whole_size(micrograph, image);
  const double whole_width = image.width, whole_height = image.height;
  image = each_slice(std::move(image),
                     [&](const GrayImage& slice) { return upright(micrograph, slice); });
  const bool lies = micrograph.rotate % 180 != 0;
  const int width = lies ? image.height : image.width, height = lies ? image.width : image.height;
  size = {size[0] * (width / whole_width), size[1] * (height / whole_height)};
  if (lies) std::swap(size[0], size[1]);
  return {std::move(image), size};
}

}  // namespace

std::optional<Picture> read_picture(const scene::Scene& scene)
{
  if (!scene.specimen.micrograph) return std::nullopt;
  try {
    return specimen_picture(*scene.specimen.micrograph);
  } catch (const InputError& error) {
    throw_in_scene(scene, error.what());
  }
}

void throw_in_scene(const scene::Scene& scene, const std::string& error)
{
  if (scene.file.empty()) throw InputError(error);
  throw InputError(scene.file.string() + ": " + error);
}

}  // namespace mpm::micrograph
