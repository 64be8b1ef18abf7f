#include <mpm/micrograph/location_means.hpp>

#include <algorithm>
#include <cstdint>

namespace mpm::micrograph {

namespace {

/// Visits the pixels of one axis that share length with part `part` of `parts`, with the shared
/// length in units of 1 / parts of a pixel; one part is `pixels` such units long.
template <class Visit>
void for_each_overlap(std::int64_t pixels, std::int64_t parts, std::int64_t part, Visit visit)
{
  const std::int64_t begin = part * pixels, end = begin + pixels;
  for (std::int64_t pixel = begin / parts; pixel * parts < end; ++pixel) {
    const std::int64_t overlap =
        std::min(end, (pixel + 1) * parts) - std::max(begin, pixel * parts);
    visit(std::size_t(pixel), double(overlap));
  }
}

}  // namespace

std::vector<double> location_means(const GrayImage& image, const IndexVec<2>& count,
                                   const IndexBox<2>& part)
{
  std::vector<double> means(std::size_t(part.size()));
  if (means.empty()) return means;
  const std::int64_t nx = count[0], ny = count[1];
  // The columns of pixels that the part touches.
  const auto first = std::size_t(part.lower[0] * std::int64_t(image.width) / nx);
  const auto end = std::size_t((part.upper[0] * std::int64_t(image.width) + nx - 1) / nx);
  std::vector<double> column_sum(end - first);
  const double area = double(image.width) * image.height;  // of a rectangle, in the units above
  double* mean = means.data();
  for (int row = part.lower[1]; row < part.upper[1]; ++row) {
    std::ranges::fill(column_sum, 0.0);
    const std::int64_t from_top = ny - 1 - row;
    for_each_overlap(image.height, ny, from_top, [&](std::size_t pixel_row, double overlap) {
      const double* gray = &image.gray[pixel_row * std::size_t(image.width) + first];
      for (std::size_t column = 0; column < column_sum.size(); ++column)
        column_sum[column] += overlap * gray[column];
    });
    for (int i = part.lower[0]; i < part.upper[0]; ++i) {
      double sum = 0;
      for_each_overlap(image.width, nx, i, [&](std::size_t pixel_column, double overlap) {
        sum += overlap * column_sum[pixel_column - first];
      });
      *mean++ = sum / area;
    }
  }
  return means;
}

}  // namespace mpm::micrograph
