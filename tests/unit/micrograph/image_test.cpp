#include <mpm/micrograph/image.hpp>

#include "image_files.hpp"
#include <gmock/gmock.h>

namespace mpm::micrograph::test {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::EndsWith;
using testing::Pointwise;
using testing::StartsWith;

const std::vector<std::array<std::uint8_t, 3>> black_red_green_blue{
    {0, 0, 0}, {255, 0, 0}, {0, 255, 0}, {0, 0, 255}};
// ITU-R BT.601: 0.299, 0.587, 0.114 of 255.
constexpr double red_luma = 76.245, green_luma = 149.685, blue_luma = 29.07;

class Image : public testing::Test {
 protected:
  GrayImage read(const Bytes& bytes) { return read_image(directory_.write("picture", bytes)); }
  std::string error_of(const Bytes& bytes)
  {
    const auto file = directory_.write("picture", bytes);
    const std::string message = message_of([&] { read_image(file); });
    EXPECT_THAT(message, StartsWith(file.string() + ": "));
    return message.substr(std::min(message.size(), file.string().size() + 2));
  }
  TemporaryDirectory directory_;
};

// ---------------------------------------------------------------------------------- slices

TEST_F(Image, FilesThatFitANameAreSlicesInTheOrderOfTheirNumbers)
{
  for (const int number : {10, 2, 1})
    directory_.write("wood_" + std::to_string(number) + "_x.bmp", gray_bmp({{number, 7}}));
  directory_.write("wood_003_x.png", png(2, 1, 8, 0, {3, 7}));
  directory_.write("other.bmp", gray_bmp({{9, 9}}));
  const GrayImage stack = read_image(directory_ / "wood_*_x.*");
  EXPECT_EQ(stack.slices, 4);
  EXPECT_EQ(stack.width, 2);
  EXPECT_EQ(stack.height, 1);
  EXPECT_THAT(stack.gray, ElementsAre(1, 7, 2, 7, 3, 7, 10, 7));
  EXPECT_EQ(read_image(directory_ / "oth*").slices, 1);
  EXPECT_EQ(read_image(directory_ / "*w*d*_*1*0*x*").slices, 1);
  EXPECT_EQ(read_image(directory_ / "**_x.bmp**").slices, 3);
}

TEST_F(Image, SlicesThatDoNotFitAreNamed)
{
  const auto error_of_slices = [&](const std::string& name) {
    return message_of([&] { read_image(directory_ / name); });
  };
  EXPECT_THAT(error_of_slices("none_*.png"),
              EndsWith("none_*.png: no file has such a name. Check the name of the slices."));
  EXPECT_THAT(error_of_slices("nowhere/*.png"),
              EndsWith("*.png: its folder does not exist. Check the name of the slices."));
  directory_.write("a_1.bmp", gray_bmp({{1, 2}}));
  directory_.write("a_2.bmp", gray_bmp({{1, 2, 3}}));
  EXPECT_THAT(error_of_slices("a_*.bmp"),
              EndsWith("a_2.bmp: slice 2 has 3 x 1 pixels, those before it 2 x 1. Give all slices "
                       "one size."));
  directory_.write("b_1.bmp", gray_bmp({{1, 2}}));
  directory_.write("b_2.bmp", {1, 2, 3});
  EXPECT_THAT(error_of_slices("b_*.bmp"),
              EndsWith("b_2.bmp: is not a BMP, PNG or TIFF image. Save it in one of these "
                       "formats."));
}

// ------------------------------------------------------------------------------------- BMP

TEST_F(Image, BottomUpBmpHasItsLastStoredRowOnTop)
{
  const GrayImage image = read(gray_bmp({{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(image.width, 3);
  EXPECT_EQ(image.height, 2);
  EXPECT_THAT(image.gray, ElementsAre(1, 2, 3, 4, 5, 6));
}

TEST_F(Image, TopDownBmpHasItsFirstStoredRowOnTop)
{
  Bytes bytes = gray_bmp({{1, 2, 3}, {4, 5, 6}});
  for (const std::size_t at : {22, 23, 24, 25}) bytes[at] = at == 22 ? 0xfe : 0xff;  // height -2
  EXPECT_THAT(read(bytes).gray, ElementsAre(4, 5, 6, 1, 2, 3));
}

TEST_F(Image, ColoursOfAnEightBitBmpBecomeLuma)
{
  const GrayImage image = read(bmp(4, 1, 8, black_red_green_blue, {3, 2, 1, 0}));
  EXPECT_THAT(image.gray, Pointwise(DoubleNear(1e-12), {blue_luma, green_luma, red_luma, 0.0}));
}

TEST_F(Image, TwentyFourBitBmpStoresBlueFirst)
{
  // One pixel a row, padded from 3 to 4 bytes; bottom row first.
  const Bytes rows{255, 0, 0, 0, 0, 0, 255, 0};
  EXPECT_THAT(read(bmp(1, 2, 24, {}, rows)).gray,
              Pointwise(DoubleNear(1e-12), {red_luma, blue_luma}));
  EXPECT_THAT(read(bmp(1, -2, 24, {}, rows)).gray,
              Pointwise(DoubleNear(1e-12), {blue_luma, red_luma}));
}

TEST_F(Image, GrayStoredAsColourStaysExact)
{
  for (int level = 0; level < 256; ++level) {
    const auto byte = std::uint8_t(level);
    EXPECT_EQ(read(bmp(1, 1, 24, {}, {byte, byte, byte, 0})).gray[0], level);
  }
}

TEST_F(Image, ThirtyTwoBitBmpIgnoresTheFourthByte)
{
  EXPECT_THAT(read(bmp(2, 1, 32, {}, {0, 255, 0, 7, 9, 9, 9, 0})).gray,
              Pointwise(DoubleNear(1e-12), {green_luma, 9.0}));
}

TEST_F(Image, NarrowBmpPixelsShareABytesHighBitsFirst)
{
  EXPECT_THAT(read(bmp(3, 1, 1, {{0, 0, 0}, {255, 255, 255}}, {0b10100000, 0, 0, 0})).gray,
              ElementsAre(255, 0, 255));
  EXPECT_THAT(read(bmp(3, 1, 4, {{10, 10, 10}, {20, 20, 20}}, {0x01, 0x10, 0, 0})).gray,
              ElementsAre(10, 20, 20));
}

TEST_F(Image, UnsuitableBmpIsRefusedWithARemedy)
{
  EXPECT_EQ(error_of(bmp(4, 1, 8, black_red_green_blue, {4, 0, 0, 1, 0, 1}, 1)),
            "is a compressed BMP (compression 1). Save it uncompressed, or as PNG.");
  EXPECT_EQ(error_of(bmp(4, 1, 8, black_red_green_blue, {0, 4, 0, 0})),
            "pixel (1, 0) has colour 4, but the BMP's table ends at 3. Save the image again.");
  EXPECT_EQ(error_of(bmp(1, 1, 16, {}, {0, 0, 0, 0})),
            "is a BMP of 16 bits per pixel. Save it with 8 (gray) or 24 (colour).");
  EXPECT_EQ(error_of(bmp(0, 1, 8, black_red_green_blue, {})),
            "the image has no pixels (0 x 1). Save it again.");
  EXPECT_THAT(error_of(bmp(1000000, 1000000, 24, {}, {})),
              StartsWith("1000000 x 1000000 pixels are too many (at most 268435456). Cut out"));
  Bytes old_header = bmp(1, 1, 24, {}, {0, 0, 0, 0});
  old_header[14] = 12;
  EXPECT_EQ(error_of(old_header), "is an OS/2 bitmap. Save it as a Windows BMP, PNG or TIFF.");
}

TEST_F(Image, BmpCutOffAnywhereIsRefused)
{
  const Bytes whole = gray_bmp({{1, 2, 3}, {4, 5, 6}});
  for (std::size_t size = 2; size < whole.size(); ++size)
    EXPECT_EQ(error_of(Bytes(whole.begin(), whole.begin() + std::ptrdiff_t(size))),
              "the BMP ends before its last pixel. Copy or save the file again.");
}

// ------------------------------------------------------------------------------------- PNG

TEST_F(Image, PngOfEachKindIsRead)
{
  EXPECT_THAT(read(png(2, 2, 8, 0, {1, 2, 3, 250})).gray, ElementsAre(1, 2, 3, 250));
  EXPECT_THAT(read(png(1, 2, 8, 2, {255, 0, 0, 0, 0, 255})).gray,
              Pointwise(DoubleNear(1e-12), {red_luma, blue_luma}));
  EXPECT_THAT(read(png(1, 1, 8, 6, {0, 255, 0, 255})).gray,
              Pointwise(DoubleNear(1e-12), {green_luma}));
  EXPECT_THAT(read(png(2, 1, 8, 4, {17, 255, 18, 255})).gray, ElementsAre(17, 18));
}

TEST_F(Image, SixteenBitPngKeepsLevelsBetweenTheWholeNumbers)
{
  // 150 * 257 = 38550 = 0x9696 is level 150; one step of 16 bits is 1 / 257 of a level.
  EXPECT_THAT(read(png(2, 1, 16, 0, {0x96, 0x96, 0x96, 0x97})).gray,
              ElementsAre(150.0, DoubleNear(150 + 1 / 257.0, 1e-12)));
}

TEST_F(Image, UnsuitablePngIsRefusedWithARemedy)
{
  EXPECT_EQ(error_of(png(1, 1, 8, 4, {17, 254})),
            "the image has transparent pixels. Flatten it onto a background, or save it without "
            "alpha.");
  Bytes cut = png(8, 8, 8, 0, Bytes(64, 1));
  cut.resize(60);
  EXPECT_THAT(error_of(cut), testing::AllOf(StartsWith("is a damaged PNG ("),
                                            EndsWith("). Copy or save the file again.")));
  EXPECT_THAT(error_of(png(100000, 100000, 8, 0, Bytes(100000, 0))),
              StartsWith("100000 x 100000 pixels are too many"));
}

// ------------------------------------------------------------------------------------- other

TEST_F(Image, FileThatIsNoImageIsRefused)
{
  EXPECT_EQ(error_of({}), "is empty. Save the image again.");
  EXPECT_EQ(error_of({'t', 'e', 'x', 't'}),
            "is not a BMP, PNG or TIFF image. Save it in one of these formats.");
  EXPECT_THAT(error_of({0xff, 0xd8, 0xff, 0xe0}), StartsWith("is a JPEG, whose compression"));
}

TEST_F(Image, MissingFileAndDirectoryAreNamed)
{
  const auto missing = directory_ / "nothing.bmp";
  EXPECT_EQ(message_of([&] { read_image(missing); }),
            missing.string() +
                ": cannot be opened (No such file or directory). Check the name of the image.");
  const auto directory = directory_ / "";
  EXPECT_EQ(message_of([&] { read_image(directory); }),
            directory.string() + ": is a directory. Name the image file in it.");
}

// ------------------------------------------------------------------------------------- turning

TEST(TurnedImage, EachQuarterTurnIsCounterClockwise)
{
  //  1 2 3
  //  4 5 6
  const GrayImage image{3, 2, {1, 2, 3, 4, 5, 6}, std::array{2e-6, 1e-6}};
  EXPECT_THAT(turned(image, 0).gray, ElementsAre(1, 2, 3, 4, 5, 6));
  const GrayImage quarter = turned(image, 90);
  EXPECT_EQ(quarter.width, 2);
  EXPECT_EQ(quarter.height, 3);
  EXPECT_EQ(quarter.pixel_size, (std::array{1e-6, 2e-6}));
  EXPECT_THAT(quarter.gray, ElementsAre(3, 6,  //
                                        2, 5,  //
                                        1, 4));
  EXPECT_THAT(turned(image, 180).gray, ElementsAre(6, 5, 4,  //
                                                   3, 2, 1));
  EXPECT_THAT(turned(image, 270).gray, ElementsAre(4, 1,  //
                                                   5, 2,  //
                                                   6, 3));
  EXPECT_EQ(message_of([&] { turned(image, 45); }),
            "specimen.rotate is 45 degrees. Give 0, 90, 180 or 270.");
}

TEST(TurnedImage, MirrorsExchangeSides)
{
  const GrayImage image{3, 2, {1, 2, 3, 4, 5, 6}, {}};
  EXPECT_THAT(mirrored(image).gray, ElementsAre(3, 2, 1, 6, 5, 4));
  EXPECT_THAT(upended(image).gray, ElementsAre(4, 5, 6, 1, 2, 3));
}

TEST(TurnedImage, CropCountsFromTheTopLeft)
{
  const GrayImage image{3, 3, {1, 2, 3, 4, 5, 6, 7, 8, 9}, {}};
  EXPECT_THAT(cropped(image, {1, 0, 2, 2}).gray, ElementsAre(2, 3, 5, 6));
  EXPECT_THAT(cropped(image, {0, 2, 1, 1}).gray, ElementsAre(7));
  for (const std::array<int, 4> part : {std::array{2, 0, 2, 1},
                                        {0, 2, 1, 2},
                                        {-1, 0, 1, 1},
                                        {0, -1, 1, 1},
                                        {0, 0, 0, 1},
                                        {0, 0, 1, 0}})
    EXPECT_EQ(
        message_of([&] { cropped(image, part); }),
        "specimen.crop is [" + std::to_string(part[0]) + ", " + std::to_string(part[1]) + ", " +
            std::to_string(part[2]) + ", " + std::to_string(part[3]) +
            "] (x, y from the top, width, height), outside the image of 3 x 3 pixels. Keep it "
            "inside.");
}

}  // namespace
}  // namespace mpm::micrograph::test
