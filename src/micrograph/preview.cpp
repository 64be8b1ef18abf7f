#include <mpm/core/error.hpp>
#include <mpm/micrograph/preview.hpp>

#include <algorithm>

// Static: another part of the program may hold its own copy of this single-file library.
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#include <stb_image_write.h>
#pragma GCC diagnostic pop

namespace mpm::micrograph {

void write_preview(const SpecimenModel& model, const std::filesystem::path& file)
{
  const Lattice& lattice = model.lattice;
  const int last = std::max<int>(1, *std::ranges::max_element(lattice.material));
  constexpr int white = 255, darkest = 96;  // well apart from black
  std::vector<std::uint8_t> pixels;
  pixels.reserve(lattice.material.size());
  for (int j = lattice.ny - 1; j >= 0; --j)
    for (int i = 0; i < lattice.nx; ++i) {
      const int material = lattice(i, j);
      pixels.push_back(material == Lattice::empty
                           ? std::uint8_t(0)
                           : std::uint8_t(white - (white - darkest) * material / last));
    }
  if (!stbi_write_png(file.c_str(), lattice.nx, lattice.ny, 1, pixels.data(), lattice.nx))
    throw FileError(file.string() +
                    ": the preview cannot be written. Check that the directory "
                    "exists, is writable and has space left.");
}

}  // namespace mpm::micrograph
