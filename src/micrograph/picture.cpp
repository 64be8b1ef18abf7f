#include <mpm/core/error.hpp>
#include <mpm/micrograph/anatomy_drawing.hpp>
#include <mpm/micrograph/picture.hpp>

#include <algorithm>
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

GrayImage drawn_image(const scene::Micrograph& micrograph)
{
  const anatomy::Parameters wood = anatomy::read_parameters(micrograph.file);
  const anatomy::Drawing drawing =
      anatomy::draw(wood, micrograph.seed ? std::uint64_t(*micrograph.seed) : wood.seed);
  const auto pixel = [](double micrometres, int pixels) { return micrometres * 1e-6 / pixels; };
  return {drawing.width,
          drawing.height,
          {drawing.gray.begin(), drawing.gray.end()},
          {{pixel(wood.picture.width, drawing.width), pixel(wood.picture.height, drawing.height)}}};
}

Picture specimen_picture(const scene::Micrograph& micrograph)
{
  GrayImage image = micrograph.is_drawn() ? drawn_image(micrograph) : read_image(micrograph.file);
  std::array<double, 2> size = whole_size(micrograph, image);
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
