#include <mpm/micrograph/picture_file.hpp>
#include <mpm/micrograph/preview.hpp>

#include <algorithm>

namespace mpm::micrograph {

template <int Dim>
void write_preview(const Specimen<Dim>& specimen, const std::filesystem::path& file,
                   int most_pixels)
{
  const IndexVec<Dim>& count = specimen.count();
  const auto& particles = specimen.particles_of_material();
  int last = int(particles.size()) - 1;
  while (last > 1 && particles[std::size_t(last)] == 0) --last;
  last = std::max(last, 1);
  constexpr int white = 255, darkest = 96;  // well apart from black
  const int longest = std::max(count[0], count[1]);
  const int stride = (longest + most_pixels - 1) / most_pixels;
  const int width = (count[0] + stride - 1) / stride, height = (count[1] + stride - 1) / stride;
  std::vector<std::uint8_t> pixels;
  pixels.reserve(std::size_t(width) * height);
  for (int j = height - 1; j >= 0; --j) {
    IndexBox<Dim> row = specimen.whole();
    if constexpr (Dim == 3) row.lower[2] = count[2] / 2;
    row.lower[1] = j * stride;
    for (int d = 1; d < Dim; ++d) row.upper[d] = row.lower[d] + 1;
    const Lattice<Dim> lattice = specimen.lattice(row);
    for (int i = 0; i < width; ++i) {
      const int material = lattice.material[std::size_t(i) * stride];
      pixels.push_back(material == Lattice<Dim>::empty
                           ? std::uint8_t(0)
                           : std::uint8_t(white - (white - darkest) * material / last));
    }
  }
  write_png(width, height, pixels, file);
}

template void write_preview<2>(const Specimen<2>&, const std::filesystem::path&, int);
template void write_preview<3>(const Specimen<3>&, const std::filesystem::path&, int);

}  // namespace mpm::micrograph
