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

/// Adds to the sums of a layer's rectangles what one slice has of them.
void add_sums(const double* slice, int width, int height, double overlap_of_slice,
              const IndexVec<2>& count, const IndexBox<2>& part, double* sum_of_rectangle)
{
  const std::int64_t nx = count[0], ny = count[1];
  // The columns of pixels that the part touches.
  const auto first = std::size_t(part.lower[0] * std::int64_t(width) / nx);
  const auto end = std::size_t((part.upper[0] * std::int64_t(width) + nx - 1) / nx);
  std::vector<double> column_sum(end - first);
  for (int row = part.lower[1]; row < part.upper[1]; ++row) {
    std::ranges::fill(column_sum, 0.0);
    const std::int64_t from_top = ny - 1 - row;
    for_each_overlap(height, ny, from_top, [&](std::size_t pixel_row, double overlap) {
      const double* gray = slice + pixel_row * std::size_t(width) + first;
      for (std::size_t column = 0; column < column_sum.size(); ++column)
        column_sum[column] += overlap * gray[column];
    });
    for (int i = part.lower[0]; i < part.upper[0]; ++i) {
      double sum = 0;
      for_each_overlap(width, nx, i, [&](std::size_t pixel_column, double overlap) {
        sum += overlap * column_sum[pixel_column - first];
      });
      *sum_of_rectangle++ += overlap_of_slice * sum;
    }
  }
}

}  // namespace

template <int Dim>
std::vector<double> location_means(const GrayImage& image, const IndexVec<Dim>& count,
                                   const IndexBox<Dim>& part)
{
  std::vector<double> means(std::size_t(part.size()));
  if (means.empty()) return means;
  const IndexVec<2> of_layer = count.template head<2>();
  const IndexBox<2> rectangles{part.lower.template head<2>(), part.upper.template head<2>()};
  const auto add = [&](std::size_t slice, double overlap, double* layer) {
    const double* gray = &image.gray[slice * std::size_t(image.width) * std::size_t(image.height)];
    add_sums(gray, image.width, image.height, overlap, of_layer, rectangles, layer);
  };
  double units = double(image.width) * image.height;  // of an area, in space of a volume
  if constexpr (Dim == 2) {
    add(0, 1, means.data());
  } else {
    units *= image.slices;
    double* layer = means.data();
    for (int k = part.lower[2]; k < part.upper[2]; ++k, layer += rectangles.size())
      for_each_overlap(image.slices, count[2], k,
                       [&](std::size_t slice, double overlap) { add(slice, overlap, layer); });
  }
  for (double& mean : means) mean /= units;
  return means;
}

template std::vector<double> location_means<2>(const GrayImage&, const IndexVec<2>&,
                                               const IndexBox<2>&);
template std::vector<double> location_means<3>(const GrayImage&, const IndexVec<3>&,
                                               const IndexBox<3>&);

}  // namespace mpm::micrograph
