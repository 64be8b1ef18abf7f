#include <mpm/micrograph/image.hpp>
#include <mpm/micrograph/picture.hpp>

#include <algorithm>
#include <fstream>

#include "image_files.hpp"
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <tiffio.h>

namespace mpm::micrograph::test {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::ElementsAreArray;
using testing::HasSubstr;
using testing::Pointwise;

/// One page and its tags; `samples` are the bytes of the rows, top row first.
struct Page {
  int width = 2, height = 2, bits = 8, channels = 1;
  Bytes samples{1, 2, 3, 4};
  int photometric = PHOTOMETRIC_MINISBLACK;
  int compression = COMPRESSION_NONE;
  int format = SAMPLEFORMAT_UINT;
  int orientation = ORIENTATION_TOPLEFT;
  bool tiled = false;
  int resolution_unit = 0;  // 0: no resolution tags
  float pixels_across = 0, pixels_down = 0;
  std::string description = {};
};

void write_page(TIFF* file, Page page)
{
  TIFFSetField(file, TIFFTAG_IMAGEWIDTH, page.width);
  TIFFSetField(file, TIFFTAG_IMAGELENGTH, page.height);
  TIFFSetField(file, TIFFTAG_BITSPERSAMPLE, page.bits);
  TIFFSetField(file, TIFFTAG_SAMPLESPERPIXEL, page.channels);
  TIFFSetField(file, TIFFTAG_PHOTOMETRIC, page.photometric);
  TIFFSetField(file, TIFFTAG_COMPRESSION, page.compression);
  TIFFSetField(file, TIFFTAG_SAMPLEFORMAT, page.format);
  TIFFSetField(file, TIFFTAG_ORIENTATION, page.orientation);
  TIFFSetField(file, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  if (page.channels == 4) {
    const std::uint16_t alpha = EXTRASAMPLE_UNASSALPHA;
    TIFFSetField(file, TIFFTAG_EXTRASAMPLES, 1, &alpha);
  }
  if (page.resolution_unit != 0) {
    TIFFSetField(file, TIFFTAG_RESOLUTIONUNIT, page.resolution_unit);
    TIFFSetField(file, TIFFTAG_XRESOLUTION, page.pixels_across);
    TIFFSetField(file, TIFFTAG_YRESOLUTION, page.pixels_down);
  }
  if (!page.description.empty())
    TIFFSetField(file, TIFFTAG_IMAGEDESCRIPTION, page.description.c_str());

  const std::size_t row_bytes = page.samples.size() / std::size_t(page.height);
  if (page.tiled) {
    constexpr int side = 16;
    const std::size_t sample_bytes = std::size_t(page.bits) / 8;
    TIFFSetField(file, TIFFTAG_TILEWIDTH, side);
    TIFFSetField(file, TIFFTAG_TILELENGTH, side);
    for (int top = 0; top < page.height; top += side)
      for (int left = 0; left < page.width; left += side) {
        Bytes tile(side * side * sample_bytes);
        for (int row = top; row < std::min(top + side, page.height); ++row)
          std::copy_n(&page.samples[std::size_t(row) * row_bytes + left * sample_bytes],
                      std::min(side, page.width - left) * sample_bytes,
                      &tile[std::size_t(row - top) * side * sample_bytes]);
        TIFFWriteTile(file, tile.data(), std::uint32_t(left), std::uint32_t(top), 0, 0);
      }
  } else {
    for (int row = 0; row < page.height; ++row)
      TIFFWriteScanline(file, &page.samples[std::size_t(row) * row_bytes], std::uint32_t(row), 0);
  }
  TIFFWriteDirectory(file);
}

class Tiff : public testing::Test {
 protected:
  std::filesystem::path write(const std::vector<Page>& pages, const char* mode = "w")
  {
    const auto file = directory_ / "picture.tif";
    TIFF* tiff = TIFFOpen(file.c_str(), mode);
    for (const Page& page : pages) write_page(tiff, page);
    TIFFClose(tiff);
    return file;
  }
  GrayImage read(const Page& page, const char* mode = "w")
  {
    return read_image(write({page}, mode));
  }
  std::string error_of(const std::vector<Page>& pages)
  {
    const auto file = write(pages);
    const std::string message = message_of([&] { read_image(file); });
    EXPECT_THAT(message, testing::StartsWith(file.string() + ": "));
    return message.substr(std::min(message.size(), file.string().size() + 2));
  }
  TemporaryDirectory directory_;
};

/// 16-bit samples in this machine's byte order, as libtiff takes them.
Bytes bytes_of(const std::vector<std::uint16_t>& samples)
{
  const auto* first = reinterpret_cast<const std::uint8_t*>(samples.data());
  return {first, first + 2 * samples.size()};
}

TEST_F(Tiff, EightBitGrayIsReadWhateverTheCompressionAndByteOrder)
{
  for (const int compression :
       {COMPRESSION_NONE, COMPRESSION_LZW, COMPRESSION_ADOBE_DEFLATE, COMPRESSION_PACKBITS})
    for (const char* mode : {"wl", "wb", "w8"}) {
      const GrayImage image = read({.compression = compression}, mode);
      EXPECT_EQ(image.width, 2);
      EXPECT_THAT(image.gray, ElementsAre(1, 2, 3, 4)) << compression << mode;
    }
}

TEST_F(Tiff, SixteenBitGrayKeepsLevelsBetweenTheWholeNumbers)
{
  for (const char* mode : {"wl", "wb"})
    EXPECT_THAT(
        read({.height = 1, .bits = 16, .samples = bytes_of({150 * 257, 150 * 257 + 1})}, mode).gray,
        ElementsAre(150.0, DoubleNear(150 + 1 / 257.0, 1e-12)));
}

TEST_F(Tiff, TilesAreJoined)
{
  // 37 x 21: tiles of 16 x 16 that reach over both edges.
  std::vector<std::uint16_t> samples;
  std::vector<double> levels;
  for (int pixel = 0; pixel < 37 * 21; ++pixel) {
    samples.push_back(std::uint16_t(pixel * 257 % 65536));
    levels.push_back(samples.back() / 257.0);
  }
  const GrayImage image = read({.width = 37,
                                .height = 21,
                                .bits = 16,
                                .samples = bytes_of(samples),
                                .compression = COMPRESSION_LZW,
                                .tiled = true});
  EXPECT_THAT(image.gray, Pointwise(DoubleNear(1e-12), levels));
}

TEST_F(Tiff, WhiteIsZeroIsTurnedRound)
{
  EXPECT_THAT(read({.photometric = PHOTOMETRIC_MINISWHITE}).gray, ElementsAre(254, 253, 252, 251));
  EXPECT_THAT(read({.height = 1,
                    .bits = 16,
                    .samples = bytes_of({0, 65535}),
                    .photometric = PHOTOMETRIC_MINISWHITE})
                  .gray,
              ElementsAre(255, 0));
}

TEST_F(Tiff, ColourBecomesLuma)
{
  const Page rgb{
      .height = 1, .channels = 3, .samples = {255, 0, 0, 9, 9, 9}, .photometric = PHOTOMETRIC_RGB};
  EXPECT_THAT(read(rgb).gray, Pointwise(DoubleNear(1e-12), {76.245, 9.0}));
  const Page rgba{.height = 1,
                  .channels = 4,
                  .samples = {0, 255, 0, 255, 9, 9, 9, 255},
                  .photometric = PHOTOMETRIC_RGB};
  EXPECT_THAT(read(rgba).gray, Pointwise(DoubleNear(1e-12), {149.685, 9.0}));
}

// --------------------------------------------------------------------------------- pixel size

TEST_F(Tiff, PixelSizeComesFromTheResolutionTags)
{
  const auto size = [this](int unit, float across, float down, const std::string& text = "") {
    return read({.resolution_unit = unit,
                 .pixels_across = across,
                 .pixels_down = down,
                 .description = text})
        .pixel_size;
  };
  const auto is = [](double width, double height) {
    // Tags are 32-bit fractions.
    return testing::Optional(
        ElementsAre(DoubleNear(width, 1e-6 * width), DoubleNear(height, 1e-6 * height)));
  };
  EXPECT_THAT(size(RESUNIT_CENTIMETER, 5000, 4000), is(2e-6, 2.5e-6));
  EXPECT_THAT(size(RESUNIT_INCH, 25400, 12700), is(1e-6, 2e-6));
  EXPECT_THAT(size(RESUNIT_NONE, 0.5, 0.25, "ImageJ=1.53t\nunit=micron\nmin=0.0\n"),
              is(2e-6, 4e-6));
  EXPECT_THAT(size(RESUNIT_NONE, 0.5, 0.5, "ImageJ=1.53t\nunit=\\u00B5m\n"), is(2e-6, 2e-6));
  EXPECT_THAT(size(RESUNIT_NONE, 500, 500, "ImageJ=1.53t\nunit=mm"), is(2e-6, 2e-6));
  EXPECT_EQ(size(RESUNIT_NONE, 1, 1), std::nullopt);
  EXPECT_EQ(size(RESUNIT_NONE, 1, 1, "ImageJ=1.53t\nunit=pixel\n"), std::nullopt);
  EXPECT_EQ(size(0, 0, 0), std::nullopt);
}

TEST_F(Tiff, ResolutionTagsSizeTheSpecimenUnlessTheSceneDoes)
{
  scene::Scene scene;
  scene.specimen.micrograph.emplace();
  scene::Micrograph& micrograph = *scene.specimen.micrograph;
  micrograph.file =
      write({{.resolution_unit = RESUNIT_CENTIMETER, .pixels_across = 5000, .pixels_down = 4000}});
  const std::array<double, 2> tagged = read_picture(scene)->size;
  EXPECT_NEAR(tagged[0], 4e-6, 1e-12);
  EXPECT_NEAR(tagged[1], 5e-6, 1e-12);
  micrograph.image_size = {1e-3, 2e-3};
  EXPECT_EQ(read_picture(scene)->size, (std::array{1e-3, 2e-3}));
}

TEST_F(Tiff, ResolutionOfAScreenIsNotTakenForAScale)
{
  scene::Scene scene;
  scene.specimen.micrograph.emplace();
  scene.specimen.micrograph->file =
      write({{.resolution_unit = RESUNIT_INCH, .pixels_across = 96, .pixels_down = 96}});
  EXPECT_THAT(message_of([&] { read_picture(scene); }),
              testing::EndsWith(": its resolution tags make a pixel 264.6 um wide, which is a "
                                "screen's or printer's, not a microscope's. Give "
                                "specimen.image_size or specimen.pixel_size."));
}

TEST_F(Tiff, PagesAreSlices)
{
  const auto file =
      write({{.samples = {1, 2, 3, 4},
              .resolution_unit = RESUNIT_CENTIMETER,
              .pixels_across = 10'000,
              .pixels_down = 5'000,
              .description = "ImageJ=1.53t\nimages=3\nslices=3\n"},
             {.samples = {5, 6, 7, 8}, .compression = COMPRESSION_LZW},
             {.bits = 16, .samples = bytes_of({9 * 257, 10 * 257, 11 * 257, 12 * 257})}});
  const GrayImage stack = read_image(file);
  EXPECT_EQ(stack.slices, 3);
  EXPECT_EQ(stack.height, 2);
  EXPECT_THAT(stack.gray, ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12));
  ASSERT_TRUE(stack.pixel_size);
  EXPECT_THAT(*stack.pixel_size, ElementsAre(DoubleNear(1e-6, 1e-15), DoubleNear(2e-6, 1e-15)));

  scene::Scene scene;
  scene.specimen.micrograph.emplace().file = file;
  EXPECT_THAT(message_of([&] { read_picture(scene); }),
              testing::EndsWith("picture.tif: is a stack of 3 slices, and the scene lies in the "
                                "plane. Give specimen.depth, the thickness of all of them, or save "
                                "the one slice to be modelled as a file of its own."));
  scene.specimen.micrograph->depth = 3e-6;
  scene.specimen.micrograph->crop = {0, 0, 2, 1};
  scene.specimen.micrograph->rotate = 90;
  const Picture picture = *read_picture(scene);
  EXPECT_EQ(picture.image.slices, 3);
  EXPECT_THAT(picture.image.gray, ElementsAre(2, 1, 6, 5, 10, 9));
  EXPECT_THAT(picture.size, ElementsAre(DoubleNear(2e-6, 1e-15), DoubleNear(2e-6, 1e-15)));
}

// --------------------------------------------------------------------------------- refusals

TEST_F(Tiff, PagesOfTwoSizesAreRefused)
{
  EXPECT_EQ(error_of({{}, {}, {.width = 1, .height = 4}}),
            "slice 3 has 1 x 4 pixels, those before it 2 x 2. Give all slices one size.");
}

/// What the pixels would take is not asked for first.
TEST_F(Tiff, MorePixelsThanTheFileHoldsAreRefused)
{
  const auto file = directory_ / "picture.tif";
  TIFF* tiff = TIFFOpen(file.c_str(), "w");
  for (const auto& [name, value] :
       {std::pair(TIFFTAG_IMAGEWIDTH, 10000), std::pair(TIFFTAG_IMAGELENGTH, 20000),
        std::pair(TIFFTAG_BITSPERSAMPLE, 8),
        std::pair(TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK)})
    TIFFSetField(tiff, std::uint32_t(name), value);
  Bytes row(10000, 7);
  TIFFWriteScanline(tiff, row.data(), 0, 0);
  TIFFClose(tiff);
  EXPECT_THAT(
      message_of([&] { read_image(file); }),
      HasSubstr(": is a damaged or unusual TIFF (10000 x 20000 pixels that are not compressed, "
                "in a file of "));
}

TEST_F(Tiff, SlicesWithoutPagesAreRefused)
{
  EXPECT_EQ(error_of({{.description = "ImageJ=1.53t\nimages=40\nslices=40\n"}}),
            "is an ImageJ stack of 40 slices in 1 pages. Save what is to be modelled as an image "
            "sequence, or as a stack of less than 4 GB.");
}

TEST_F(Tiff, PagesThatAreChannelsOrTimesAreRefused)
{
  for (const char* other : {"channels", "frames"})
    EXPECT_EQ(
        error_of({{.description =
                       fmt::format("ImageJ=1.53t\nimages=1\n{}=2\nhyperstack=true\n", other)}}),
        fmt::format("is an ImageJ hyperstack of 2 {}, whose pages are not all slices. Save one "
                    "of them as a stack (Image > Hyperstacks > Make Subset).",
                    other));
}

TEST_F(Tiff, FloatingPointSamplesAreRefused)
{
  EXPECT_EQ(error_of({{.width = 1, .height = 1, .bits = 32, .format = SAMPLEFORMAT_IEEEFP}}),
            "is a TIFF of 32-bit floating-point samples. Convert it to 8 or 16 bits, unsigned.");
}

TEST_F(Tiff, TurnedTiffIsRefused)
{
  EXPECT_EQ(error_of({{.orientation = ORIENTATION_BOTLEFT}}),
            "has the TIFF orientation tag 4, which viewers treat differently. Save it upright.");
}

TEST_F(Tiff, TransparentPixelsAreRefused)
{
  EXPECT_THAT(error_of({{.width = 1,
                         .height = 1,
                         .channels = 4,
                         .samples = {9, 9, 9, 0},
                         .photometric = PHOTOMETRIC_RGB}}),
              HasSubstr("transparent pixels"));
}

TEST_F(Tiff, DamagedFileIsRefusedWithoutNoise)
{
  testing::internal::CaptureStderr();
  for (const int bits : {8, 16}) {
    const Page page{.width = 64,
                    .height = 64,
                    .bits = bits,
                    .samples = Bytes(std::size_t(64 * 64 * bits / 8), 7),
                    .compression = COMPRESSION_ADOBE_DEFLATE};
    auto file = write({page});
    std::fstream(file, std::ios::in | std::ios::out | std::ios::binary).seekp(8) << "no zlib data";
    EXPECT_THAT(message_of([&] { read_image(file); }),
                HasSubstr(": is a damaged or unusual TIFF ("));
    file = write({page});
    std::filesystem::resize_file(file, 20);  // the directory of pages is written last
    EXPECT_THAT(message_of([&] { read_image(file); }),
                HasSubstr(": is a damaged or unusual TIFF ("));
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace mpm::micrograph::test
