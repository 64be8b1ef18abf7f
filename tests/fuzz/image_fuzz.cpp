/// Any bytes as an image: refused with words, or as many gray levels as it says, each from black to
/// white.

#include <mpm/core/error.hpp>
#include <mpm/micrograph/image.hpp>

#include "file_in_memory.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size)
{
  const FileInMemory file(bytes, size);
  try {
    const mpm::micrograph::GrayImage image = mpm::micrograph::read_image(file.path());
    if (image.width <= 0 || image.height <= 0 || image.slices <= 0 ||
        image.gray.size() !=
            std::size_t(image.width) * std::size_t(image.height) * std::size_t(image.slices))
      throw std::logic_error("not as many gray levels as pixels");
    for (const double gray : image.gray)
      if (!(gray >= 0 && gray <= 255)) throw std::logic_error("a gray level that is none");
    if (image.pixel_size)
      for (const double length : *image.pixel_size)
        if (!(length > 0)) throw std::logic_error("a pixel without a size");
  } catch (const mpm::InputError& error) {
    if (std::string(error.what()).empty()) throw std::logic_error("refused without a word");
  }
  return 0;
}
