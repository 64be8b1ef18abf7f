#include <mpm/micrograph/image_formats.hpp>

#include <algorithm>
#include <bit>
#include <cstdarg>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <tiffio.h>

namespace mpm::micrograph {

namespace {

/// While alive, libtiff keeps its complaints to itself and we keep the first error.
class QuietTiff {
 public:
  QuietTiff() : warning_(TIFFSetWarningHandler(nullptr)), error_(TIFFSetErrorHandler(&keep))
  {
    first_error().clear();
  }
  ~QuietTiff()
  {
    TIFFSetWarningHandler(warning_);
    TIFFSetErrorHandler(error_);
  }
  QuietTiff(const QuietTiff&) = delete;
  QuietTiff& operator=(const QuietTiff&) = delete;

  [[noreturn]] static void fail()
  {
    fail_since(first_error().empty() ? "no reason given" : first_error());
  }
  [[noreturn]] static void fail_since(std::string_view reason)
  {
    throw InputError(
        fmt::format("is a damaged or unusual TIFF ({}). Save it again, as 8-bit gray.", reason));
  }

 private:
  static std::string& first_error()
  {
    thread_local std::string text;
    return text;
  }
  static void keep(const char*, const char* format, va_list arguments)
  {
    if (!first_error().empty()) return;
    char text[400];
    std::vsnprintf(text, sizeof text, format, arguments);
    first_error() = text;
    while (!first_error().empty() && first_error().back() == '.') first_error().pop_back();
  }
  TIFFErrorHandler warning_, error_;
};

struct Close {
  void operator()(TIFF* file) const { TIFFClose(file); }
};

template <class Value>
Value tag(TIFF* file, std::uint32_t name)
{
  Value value{};
  TIFFGetFieldDefaulted(file, name, &value);
  return value;
}

std::string_view description(TIFF* file)
{
  const char* text = nullptr;
  return TIFFGetField(file, TIFFTAG_IMAGEDESCRIPTION, &text) && text ? text : "";
}

/// The value of `key=value` in the lines that ImageJ writes into a description, or "".
std::string_view imagej_entry(std::string_view text, std::string_view key)
{
  if (!text.starts_with("ImageJ=")) return "";
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    if (line.starts_with(key) && line.substr(key.size()).starts_with('='))
      return line.substr(key.size() + 1);
    text.remove_prefix(std::min(text.size(), line.size() + 1));
  }
  return "";
}

/// Length in m that the resolution counts pixels over, or nothing. ImageJ knows more units than
/// TIFF and then writes "none" with the unit's name in the description.
std::optional<double> resolution_length(TIFF* file)
{
  const int unit = tag<std::uint16_t>(file, TIFFTAG_RESOLUTIONUNIT);
  if (unit == RESUNIT_CENTIMETER) return 1e-2;
  const std::string_view text = description(file);
  if (unit == RESUNIT_INCH && !text.starts_with("ImageJ=")) return 25.4e-3;
  const std::string_view name = imagej_entry(text, "unit");
  if (name == "inch") return 25.4e-3;
  if (name == "cm") return 1e-2;
  if (name == "mm") return 1e-3;
  if (name == "micron" || name == "um" || name == "\\u00B5m" || name == "\xc2\xb5m") return 1e-6;
  if (name == "nm") return 1e-9;
  return {};
}

std::optional<std::array<double, 2>> pixel_size(TIFF* file)
{
  const std::optional<double> length = resolution_length(file);
  float across = 0, down = 0;  // pixels per length
  if (!length || !TIFFGetField(file, TIFFTAG_XRESOLUTION, &across) ||
      !TIFFGetField(file, TIFFTAG_YRESOLUTION, &down) || !(across > 0) || !(down > 0))
    return {};
  return std::array{*length / across, *length / down};
}

void check_suitable(TIFF* file, int pages)
{
  // Stacks beyond 4 GB name their slices in the description only.
  const std::string_view slices = imagej_entry(description(file), "images");
  if (!slices.empty() && slices != fmt::format("{}", pages))
    throw InputError(fmt::format(
        "is an ImageJ stack of {} slices in {} pages. Save what is to be modelled as an "
        "image sequence, or as a stack of less than 4 GB.",
        slices, pages));
  for (const char* other : {"channels", "frames"})
    if (const std::string_view count = imagej_entry(description(file), other);
        !count.empty() && count != "1")
      throw InputError(fmt::format(
          "is an ImageJ hyperstack of {} {}, whose pages are not all slices. Save one of them as a "
          "stack (Image > Hyperstacks > Make Subset).",
          count, other));
  const int orientation = tag<std::uint16_t>(file, TIFFTAG_ORIENTATION);
  if (orientation != ORIENTATION_TOPLEFT)
    throw InputError(fmt::format(
        "has the TIFF orientation tag {}, which viewers treat differently. Save it upright.",
        orientation));
  const int format = tag<std::uint16_t>(file, TIFFTAG_SAMPLEFORMAT);
  const int bits = tag<std::uint16_t>(file, TIFFTAG_BITSPERSAMPLE);
  if (format != SAMPLEFORMAT_UINT || bits > 16)
    throw InputError(
        fmt::format("is a TIFF of {}-bit {} samples. Convert it to 8 or 16 bits, unsigned.", bits,
                    format == SAMPLEFORMAT_IEEEFP ? "floating-point" : "integer"));
}

/// 16-bit gray keeps its levels; libtiff's general reader would cut them to 8 bits.
GrayImage read_gray16(TIFF* file, int width, int height)
{
  std::vector<std::uint16_t> samples(std::size_t(width) * height);
  if (TIFFIsTiled(file)) {
    const int tile_width = int(tag<std::uint32_t>(file, TIFFTAG_TILEWIDTH));
    const int tile_height = int(tag<std::uint32_t>(file, TIFFTAG_TILELENGTH));
    std::vector<std::uint16_t> tile(std::size_t(TIFFTileSize(file)) / 2);
    if (tile.empty() || tile.size() < std::size_t(tile_width) * tile_height) QuietTiff::fail();
    for (int top = 0; top < height; top += tile_height)
      for (int left = 0; left < width; left += tile_width) {
        if (TIFFReadTile(file, tile.data(), std::uint32_t(left), std::uint32_t(top), 0, 0) < 0)
          QuietTiff::fail();
        for (int row = top; row < std::min(top + tile_height, height); ++row)
          std::copy_n(&tile[std::size_t(row - top) * tile_width],
                      std::min(tile_width, width - left),
                      &samples[std::size_t(row) * width + left]);
      }
  } else {
    for (int row = 0; row < height; ++row)
      if (TIFFReadScanline(file, &samples[std::size_t(row) * width], std::uint32_t(row), 0) < 0)
        QuietTiff::fail();
  }
  if (tag<std::uint16_t>(file, TIFFTAG_PHOTOMETRIC) == PHOTOMETRIC_MINISWHITE)
    for (std::uint16_t& sample : samples) sample = std::uint16_t(~sample);
  return gray_from_samples<std::uint16_t>(samples, width, height, 1);
}

/// Anything libtiff can turn into 8-bit red, green, blue, alpha: gray, palettes, colour, YCbCr.
GrayImage read_rgba(TIFF* file, int width, int height)
{
  static_assert(std::endian::native == std::endian::little, "libtiff packs red in the lowest byte");
  std::vector<std::uint32_t> raster(std::size_t(width) * height);
  const int stop_on_error = 1;
  if (!TIFFReadRGBAImageOriented(file, std::uint32_t(width), std::uint32_t(height), raster.data(),
                                 ORIENTATION_TOPLEFT, stop_on_error))
    QuietTiff::fail();
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(raster.data());
  return gray_from_samples<std::uint8_t>({bytes, 4 * raster.size()}, width, height, 4);
}

/// A header may say anything: before memory is taken for the pixels, whether they can be there.
void check_room(TIFF* file, std::uint32_t width, std::uint32_t height)
{
  if (tag<std::uint16_t>(file, TIFFTAG_COMPRESSION) != COMPRESSION_NONE) return;
  const std::uint64_t there = TIFFGetSizeProc(file)(TIFFClientdata(file));
  if (TIFFScanlineSize64(file) > there / height)
    QuietTiff::fail_since(fmt::format(
        "{} x {} pixels that are not compressed, in a file of {} bytes", width, height, there));
}

/// `before`: the slices that were read so far, or null.
GrayImage read_page(TIFF* file, int pages, const GrayImage* before)
{
  check_suitable(file, pages);
  const auto width = tag<std::uint32_t>(file, TIFFTAG_IMAGEWIDTH);
  const auto height = tag<std::uint32_t>(file, TIFFTAG_IMAGELENGTH);
  check_dimensions(width, height, pages);
  if (before) check_next_slice(*before, width, height);
  check_room(file, width, height);
  const bool gray16 = tag<std::uint16_t>(file, TIFFTAG_BITSPERSAMPLE) == 16 &&
                      tag<std::uint16_t>(file, TIFFTAG_SAMPLESPERPIXEL) == 1;
  GrayImage image = gray16 ? read_gray16(file, int(width), int(height))
                           : read_rgba(file, int(width), int(height));
  image.pixel_size = pixel_size(file);
  return image;
}

}  // namespace

GrayImage read_tiff(const std::filesystem::path& path)
{
  const QuietTiff quiet;
  const std::unique_ptr<TIFF, Close> file(TIFFOpen(path.c_str(), "r"));
  if (!file) QuietTiff::fail();
  const int pages = TIFFNumberOfDirectories(file.get());
  GrayImage stack = read_page(file.get(), pages, nullptr);
  for (int page = 1; page < pages; ++page) {
    if (!TIFFReadDirectory(file.get())) QuietTiff::fail();
    add_slice(stack, read_page(file.get(), pages, &stack));
  }
  return stack;
}

}  // namespace mpm::micrograph
