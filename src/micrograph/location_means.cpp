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

std::vector<double> location_means(const GrayImage& image, int nx, int ny)
{
  std::vector<double> means(std::size_t(nx) * ny);
  std::vector<double> column_sum(image.width);
  const double area = double(image.width) * image.height;  // of a rectangle, in the units above
  for (int row = 0; row < ny; ++row) {
    std::ranges::fill(column_sum, 0.0);
    const int from_top = ny - 1 - row;
    for_each_overlap(image.height, ny, from_top, [&](std::size_t pixel_row, double overlap) {
      const double* gray = &image.gray[pixel_row * column_sum.size()];
      for (std::size_t column = 0; column < column_sum.size(); ++column)
        column_sum[column] += overlap * gray[column];
    });
    double* mean = &means[std::size_t(row) * nx];
    for (int i = 0; i < nx; ++i) {
      double sum = 0;
      for_each_overlap(image.width, nx, i, [&](std::size_t pixel_column, double overlap) {
        sum += overlap * column_sum[pixel_column];
      });
      mean[i] = sum / area;
    }
  }
  return means;
}

}  // namespace mpm::micrograph
