#include <mpm/core/index_box.hpp>
#include <mpm/micrograph/lattice.hpp>
#include <mpm/micrograph/wall_places.hpp>

#include <algorithm>
#include <cmath>

namespace mpm::micrograph {

namespace {

/// Shapes are looked up by the tile of locations in which a place lies.
template <int Dim>
class ShapePlaces final : public WallPlaces<Dim> {
 public:
  ShapePlaces(std::span<const scene::Shape> shapes, std::span<const std::int8_t> materials,
              const Vec<Dim>& size, const IndexVec<Dim>& count)
      : shapes_(shapes.begin(), shapes.end()), materials_(materials.begin(), materials.end())
  {
    for (int d = 0; d < Dim; ++d) {
      location_[d] = size[d] / count[d];
      tiles_.upper[d] = count[d] / tile + 1;
    }
    of_tile_.resize(std::size_t(tiles_.size()));
    for (std::size_t shape = 0; shape < shapes_.size(); ++shape) {
      const scene::Extent extent = std::visit(
          [](const auto& kind) -> scene::Extent { return kind.extent(); }, shapes_[shape].geometry);
      IndexBox<Dim> near;
      for (int d = 0; d < Dim; ++d) {
        const auto tile_at = [&](double place) {
          return LocalIndex(
              std::clamp(std::floor(place / (tile * location_[d])), 0.0, tiles_.upper[d] - 1.0));
        };
        near.lower[d] = tile_at(extent.lower[std::size_t(d)]);
        near.upper[d] = tile_at(extent.upper[std::size_t(d)]) + 1;
      }
      for_each_index(near, [&](const IndexVec<Dim>& at) {
        of_tile_[std::size_t(number_in(tiles_, at))].push_back(shape);
      });
    }
  }

  bool contains(const Vec<Dim>& place) const override
  {
    scene::Point<Dim> point;
    IndexVec<Dim> at;
    for (int d = 0; d < Dim; ++d) {
      point[std::size_t(d)] = place[d] * location_[d];
      at[d] = LocalIndex(place[d] / tile);
    }
    // The last one that contains it, as for locations.
    const auto& near = of_tile_[std::size_t(number_in(tiles_, at))];
    for (auto shape = near.rbegin(); shape != near.rend(); ++shape) {
      const bool inside = std::visit(
          [&]<class Kind>(const Kind& kind) {
            if constexpr (scene::lies_in<Kind>(Dim))
              return kind.contains(point);
            else
              return false;
          },
          shapes_[*shape].geometry);
      if (inside) return materials_[*shape] != Lattice<Dim>::empty;
    }
    return false;
  }

 private:
  static constexpr int tile = 16;  // locations along each axis
  std::vector<scene::Shape> shapes_;
  std::vector<std::int8_t> materials_;
  Vec<Dim> location_;  // m
  IndexBox<Dim> tiles_;
  std::vector<std::vector<std::size_t>> of_tile_;  // in the order in which they are drawn
};

/// The pixel that stands for one beyond the picture.
int folded(int pixel, int count, bool periodic)
{
  if (periodic) return ((pixel % count) + count) % count;
  const int twice = ((pixel % (2 * count)) + 2 * count) % (2 * count);
  return twice < count ? twice : 2 * count - 1 - twice;
}

/// Sums over boxes from sums over all pixels below and to the left of a point.
template <int Dim>
class PicturePlaces final : public WallPlaces<Dim> {
 public:
  PicturePlaces(const WallLevels& pixels, const IndexVec<Dim>& count,
                const std::array<bool, 2>& periodic)
  {
    const std::array<int, 2> size{pixels.width, pixels.height};
    std::array<int, 2> padded{};
    for (std::size_t d = 0; d < 2; ++d) {
      pixels_[d] = double(size[d]) / count[int(d)];
      half_[d] = 0.5 * std::max(box * pixels_[d], least_pixels);
      padding_[d] = int(std::ceil(half_[d])) + 1;
      padded[d] = size[d] + 2 * padding_[d];
    }
    columns_ = padded[0] + 1;
    sums_.assign(std::size_t(columns_) * std::size_t(padded[1] + 1), 0.0);
    for (int row = 0; row < padded[1]; ++row) {
      const int from_top = size[1] - 1 - folded(row - padding_[1], size[1], periodic[1]);
      double of_row = 0;
      for (int column = 0; column < padded[0]; ++column) {
        of_row += pixels(folded(column - padding_[0], size[0], periodic[0]), from_top);
        sum(column + 1, row + 1) = sum(column + 1, row) + of_row;
      }
    }
    // At four places of each pixel: in the middles alone there would be no blur.
    std::vector<double> means;
    means.reserve(4 * pixels.level.size());
    for (int row = 0; row < 2 * size[1]; ++row)
      for (int column = 0; column < 2 * size[0]; ++column)
        means.push_back(in_box(padding_[0] + 0.5 * column + 0.25, padding_[1] + 0.5 * row + 0.25));
    const auto below = std::llround((1 - pixels.density) * double(means.size()));
    const auto limit = means.begin() + std::min<std::ptrdiff_t>(below, std::ssize(means) - 1);
    std::nth_element(means.begin(), limit, means.end());
    level_ = *limit;
  }

  bool contains(const Vec<Dim>& place) const override
  {
    return in_box(place[0] * pixels_[0] + padding_[0], place[1] * pixels_[1] + padding_[1]) >=
           level_;
  }

 private:
  static constexpr double box = 0.75;  // locations
  static constexpr double least_pixels = 1;

  double& sum(int column, int row)
  {
    return sums_[std::size_t(row) * std::size_t(columns_) + std::size_t(column)];
  }
  /// Sum of the levels over the box around a point, pixels of what is padded.
  double in_box(double x, double y) const
  {
    return (below(x + half_[0], y + half_[1]) - below(x - half_[0], y + half_[1])) -
           (below(x + half_[0], y - half_[1]) - below(x - half_[0], y - half_[1]));
  }
  /// Bilinear between the corners of pixels, which is exact.
  double below(double x, double y) const
  {
    const double i = std::floor(x), j = std::floor(y), u = x - i, v = y - j;
    const double* at = &sums_[std::size_t(j) * std::size_t(columns_) + std::size_t(i)];
    const double* above = at + columns_;
    return (1 - v) * ((1 - u) * at[0] + u * at[1]) + v * ((1 - u) * above[0] + u * above[1]);
  }

  std::array<double, 2> pixels_{};  // of a location
  std::array<double, 2> half_{};    // of the box, pixels
  std::array<int, 2> padding_{};    // pixels
  int columns_ = 0;
  std::vector<double> sums_;
  double level_ = 0;  // of a box
};

}  // namespace

template <int Dim>
std::unique_ptr<WallPlaces<Dim>> places_of_shapes(std::span<const scene::Shape> shapes,
                                                  std::span<const std::int8_t> materials,
                                                  const Vec<Dim>& size, const IndexVec<Dim>& count)
{
  return std::make_unique<ShapePlaces<Dim>>(shapes, materials, size, count);
}

template <int Dim>
std::unique_ptr<WallPlaces<Dim>> places_of_picture(const WallLevels& pixels,
                                                   const IndexVec<Dim>& count,
                                                   const std::array<bool, 2>& periodic)
{
  return std::make_unique<PicturePlaces<Dim>>(pixels, count, periodic);
}

template std::unique_ptr<WallPlaces<2>> places_of_shapes(std::span<const scene::Shape>,
                                                         std::span<const std::int8_t>,
                                                         const Vec<2>&, const IndexVec<2>&);
template std::unique_ptr<WallPlaces<3>> places_of_shapes(std::span<const scene::Shape>,
                                                         std::span<const std::int8_t>,
                                                         const Vec<3>&, const IndexVec<3>&);
template std::unique_ptr<WallPlaces<2>> places_of_picture(const WallLevels&, const IndexVec<2>&,
                                                          const std::array<bool, 2>&);
template std::unique_ptr<WallPlaces<3>> places_of_picture(const WallLevels&, const IndexVec<3>&,
                                                          const std::array<bool, 2>&);

}  // namespace mpm::micrograph
