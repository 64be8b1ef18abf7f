#include <mpm/core/memory.hpp>
#include <mpm/micrograph/image.hpp>
#include <mpm/micrograph/image_formats.hpp>
#include <mpm/scene/slices.hpp>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string_view>

#include <fmt/format.h>

namespace mpm::micrograph {

namespace {

std::vector<std::uint8_t> bytes_of(const std::filesystem::path& file)
{
  if (std::filesystem::is_directory(file))
    throw InputError("is a directory. Name the image file in it.");
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  if (!stream)
    throw InputError(
        fmt::format("cannot be opened ({}). Check the name of the image.", std::strerror(errno)));
  std::vector<std::uint8_t> bytes(std::size_t(stream.tellg()));
  stream.seekg(0);
  if (!stream.read(reinterpret_cast<char*>(bytes.data()), std::streamsize(bytes.size())))
    throw InputError("cannot be read to its end. Copy the file again.");
  return bytes;
}

bool starts_with(std::span<const std::uint8_t> bytes, std::string_view magic)
{
  return bytes.size() >= magic.size() &&
         std::equal(magic.begin(), magic.end(), bytes.begin(),
                    [](char a, std::uint8_t b) { return std::uint8_t(a) == b; });
}

GrayImage read_by_format(const std::filesystem::path& file)
{
  using namespace std::string_view_literals;
  const std::vector<std::uint8_t> bytes = bytes_of(file);
  if (bytes.empty()) throw InputError("is empty. Save the image again.");
  if (starts_with(bytes, "BM")) return read_bmp(bytes);
  if (starts_with(bytes, "\x89PNG\r\n\x1a\n")) return read_png(bytes);
  // Classic and big TIFF, in either byte order.
  if (starts_with(bytes, "II*\0"sv) || starts_with(bytes, "MM\0*"sv) ||
      starts_with(bytes, "II+\0"sv) || starts_with(bytes, "MM\0+"sv))
    return read_tiff(file);
  if (starts_with(bytes, "\xff\xd8\xff"))
    throw InputError(
        "is a JPEG, whose compression shifts gray levels at the walls. Save it as PNG or TIFF.");
  throw InputError("is not a BMP, PNG or TIFF image. Save it in one of these formats.");
}

/// Whether a name is the pattern with any letters in place of each `*`.
bool fits(std::string_view name, std::string_view pattern)
{
  // What follows a `*` is looked for as early as it can be: later ones find no less of the name.
  std::size_t at = 0, expected = 0, star = pattern.npos, behind_star = 0;
  while (at < name.size()) {
    if (expected < pattern.size() && pattern[expected] == '*') {
      star = expected++;
      behind_star = at;
    } else if (expected < pattern.size() && pattern[expected] == name[at]) {
      ++expected;
      ++at;
    } else if (star != pattern.npos) {
      expected = star + 1;
      at = ++behind_star;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', expected) == pattern.npos;
}

/// `wood_9` before `wood_10`: numbers count as such.
bool comes_before(std::string_view a, std::string_view b)
{
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  while (!a.empty() && !b.empty()) {
    if (!is_digit(a.front()) || !is_digit(b.front())) {
      if (a.front() != b.front()) return a.front() < b.front();
      a.remove_prefix(1);
      b.remove_prefix(1);
      continue;
    }
    const auto number = [&](std::string_view& text) {
      while (text.size() > 1 && text[0] == '0' && is_digit(text[1])) text.remove_prefix(1);
      std::size_t digits = 0;
      while (digits < text.size() && is_digit(text[digits])) ++digits;
      const std::string_view found = text.substr(0, digits);
      text.remove_prefix(digits);
      return found;
    };
    const std::string_view one = number(a), other = number(b);
    if (one.size() != other.size()) return one.size() < other.size();
    if (one != other) return one < other;
  }
  return a.size() < b.size();
}

}  // namespace

std::vector<std::filesystem::path> files_of_image(const std::filesystem::path& pattern)
{
  if (!scene::names_slices(pattern)) return {pattern};
  const std::filesystem::path folder =
      pattern.has_parent_path() ? pattern.parent_path() : std::filesystem::path(".");
  if (!std::filesystem::is_directory(folder))
    throw InputError(pattern.string() +
                     ": its folder does not exist. Check the name of the slices.");
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.is_regular_file() &&
        fits(entry.path().filename().string(), pattern.filename().string()))
      files.push_back(entry.path());
  if (files.empty())
    throw InputError(pattern.string() + ": no file has such a name. Check the name of the slices.");
  std::ranges::sort(files, [](const auto& a, const auto& b) {
    const std::string one = a.filename().string(), other = b.filename().string();
    return comes_before(one, other) || (!comes_before(other, one) && one < other);
  });
  return files;
}

namespace {

/// Does what may be refused, and then with the file's name.
template <class Action>
auto naming(const std::filesystem::path& file, const Action& action)
{
  try {
    return action();
  } catch (const InputError& error) {
    throw InputError(file.string() + ": " + error.what());
  }
}

GrayImage named_read(const std::filesystem::path& file)
{
  return naming(file, [&] { return read_by_format(file); });
}

/// Of one file that fits a name.
GrayImage read_slice(const std::filesystem::path& file)
{
  GrayImage slice = named_read(file);
  if (slice.slices > 1)
    throw InputError(
        fmt::format("{}: is a stack of {} slices itself. Name it alone, without a `*`.",
                    file.string(), slice.slices));
  return slice;
}

GrayImage read_slices(const std::vector<std::filesystem::path>& files)
{
  GrayImage stack = read_slice(files.front());
  naming(files.front(),
         [&] { check_dimensions(stack.width, stack.height, std::int64_t(files.size())); });
  for (std::size_t k = 1; k < files.size(); ++k) {
    const GrayImage slice = read_slice(files[k]);
    naming(files[k], [&] { add_slice(stack, slice); });
  }
  return stack;
}

}  // namespace

void check_next_slice(const GrayImage& stack, std::int64_t width, std::int64_t height)
{
  if (width != stack.width || height != stack.height)
    throw InputError(
        fmt::format("slice {} has {} x {} pixels, those before it {} x {}. Give all slices one "
                    "size.",
                    stack.slices + 1, width, height, stack.width, stack.height));
}

void add_slice(GrayImage& stack, const GrayImage& slice)
{
  check_next_slice(stack, slice.width, slice.height);
  stack.gray.insert(stack.gray.end(), slice.gray.begin(), slice.gray.end());
  ++stack.slices;
}

GrayImage each_slice(GrayImage image, const std::function<GrayImage(const GrayImage&)>& change)
{
  if (image.slices == 1) return change(image);
  GrayImage stack;
  const std::size_t pixels = std::size_t(image.width) * image.height;
  for (int k = 0; k < image.slices; ++k) {
    const auto first = image.gray.begin() + std::ptrdiff_t(k * pixels);
    GrayImage slice = change(
        {image.width, image.height, {first, first + std::ptrdiff_t(pixels)}, image.pixel_size, 1});
    if (k == 0)
      stack = std::move(slice);
    else
      add_slice(stack, slice);
  }
  return stack;
}

void check_dimensions(std::int64_t width, std::int64_t height, std::int64_t slices)
{
  if (width <= 0 || height <= 0)
    throw InputError(
        fmt::format("the image has no pixels ({} x {}). Save it again.", width, height));
  if (slices > 1 && width <= most_pixels / height && slices > most_pixels / (width * height))
    throw InputError(fmt::format(
        "{} slices of {} x {} pixels are too many (at most {} pixels). Cut out the part "
        "to be modelled, or scale the slices down.",
        slices, width, height, most_pixels));
  if (width > most_pixels / height)
    throw InputError(
        fmt::format("{} x {} pixels are too many (at most {}). Cut out the part to be modelled, or "
                    "scale the image down.",
                    width, height, most_pixels));
  constexpr double bytes_per_pixel = 16;  // as numbers, and once more while it is read or cut
  const double bytes = bytes_per_pixel * double(width) * double(height) * double(slices);
  if (bytes > memory_limit())
    throw InputError(fmt::format(
        "{} x {} x {} pixels take {} of memory on each rank, and there are {}. Cut out the part to "
        "be modelled, or scale the image down.",
        width, height, slices, memory_text(bytes), memory_text(memory_limit())));
}

GrayImage read_image(const std::filesystem::path& file)
{
  return scene::names_slices(file) ? read_slices(files_of_image(file)) : named_read(file);
}

GrayImage cropped(const GrayImage& image, const std::array<int, 4>& part)
{
  const auto [left, top, width, height] = part;
  if (left < 0 || top < 0 || width <= 0 || height <= 0 || width > image.width - left ||
      height > image.height - top)
    throw InputError(
        fmt::format("specimen.crop is [{}, {}, {}, {}] (x, y from the top, width, height), outside "
                    "the image of {} x {} pixels. Keep it inside.",
                    left, top, width, height, image.width, image.height));
  GrayImage result{width, height, {}, image.pixel_size, 1};
  result.gray.reserve(std::size_t(width) * height);
  for (int row = top; row < top + height; ++row) {
    const double* first = &image.gray[std::size_t(row) * image.width + left];
    result.gray.insert(result.gray.end(), first, first + width);
  }
  return result;
}

GrayImage turned(const GrayImage& image, int degrees)
{
  switch (degrees) {
    case 0:
      return image;
    case 180:
      return upended(mirrored(image));
    case 270:
      return turned(turned(image, 180), 90);
    case 90:
      break;
    default:
      throw InputError(
          fmt::format("specimen.rotate is {} degrees. Give 0, 90, 180 or 270.", degrees));
  }
  // The right column becomes the top row.
  GrayImage result{image.height, image.width, std::vector<double>(image.gray.size()), {}, 1};
  if (image.pixel_size) result.pixel_size = {(*image.pixel_size)[1], (*image.pixel_size)[0]};
  for (int row = 0; row < result.height; ++row)
    for (int column = 0; column < result.width; ++column)
      result(column, row) = image(image.width - 1 - row, column);
  return result;
}

GrayImage mirrored(const GrayImage& image)
{
  GrayImage result = image;
  for (int row = 0; row < image.height; ++row) {
    const auto first = result.gray.begin() + std::ptrdiff_t(row) * image.width;
    std::reverse(first, first + image.width);
  }
  return result;
}

GrayImage upended(const GrayImage& image)
{
  GrayImage result = image;
  for (int row = 0; row < image.height; ++row)
    std::copy_n(image.gray.begin() + std::ptrdiff_t(row) * image.width, image.width,
                result.gray.begin() + std::ptrdiff_t(image.height - 1 - row) * image.width);
  return result;
}

}  // namespace mpm::micrograph
