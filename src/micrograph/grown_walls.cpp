#include <mpm/micrograph/grown_walls.hpp>
#include <mpm/micrograph/threshold.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

namespace mpm::micrograph {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The least of f(q) + ((p - q) h)^2 over all q, for every place p of a line: the lower envelope of
/// parabolas.
class LowerEnvelope {
 public:
  explicit LowerEnvelope(std::size_t length) : places_(length), from_(length + 1), result_(length)
  {
  }

  void apply(std::span<double> line, double h)
  {
    const double square = h * h;
    std::size_t count = 0;
    for (std::size_t q = 0; q < line.size(); ++q) {
      if (line[q] == infinity) continue;
      double begin = -infinity;
      while (count > 0) {
        begin = meeting(line, places_[count - 1], q, square);
        if (begin > from_[count - 1]) break;
        --count;
      }
      if (count == 0) begin = -infinity;
      places_[count] = q;
      from_[count++] = begin;
    }
    if (count == 0) return;
    from_[count] = infinity;
    std::size_t k = 0;
    for (std::size_t p = 0; p < line.size(); ++p) {
      while (from_[k + 1] < double(p)) ++k;
      const double away = double(p) - double(places_[k]);
      result_[p] = line[places_[k]] + away * away * square;
    }
    std::copy_n(result_.begin(), line.size(), line.begin());
  }

 private:
  /// Where the parabolas of places a < b have the same height.
  static double meeting(std::span<const double> line, std::size_t a, std::size_t b, double square)
  {
    const double first = double(a), second = double(b);
    return ((line[b] - line[a]) / square + second * second - first * first) /
           (2 * (second - first));
  }

  std::vector<std::size_t> places_;
  std::vector<double> from_, result_;
};

/// Squares of the distances between pixels' centres to the nearest pixel of a kind, in units of
/// `pixel`.
std::vector<double> squared_distances(const GrayImage& image, const std::vector<char>& kind,
                                      const std::array<double, 2>& pixel)
{
  const auto width = std::size_t(image.width), height = std::size_t(image.height);
  std::vector<double> squares(kind.size());
  std::ranges::transform(kind, squares.begin(),
                         [](char of_kind) { return of_kind ? 0 : infinity; });
  LowerEnvelope envelope(std::max(width, height));
  for (std::size_t row = 0; row < height; ++row)
    envelope.apply(std::span(squares).subspan(row * width, width), pixel[0]);
  std::vector<double> column(height);
  for (std::size_t i = 0; i < width; ++i) {
    for (std::size_t row = 0; row < height; ++row) column[row] = squares[row * width + i];
    envelope.apply(column, pixel[1]);
    for (std::size_t row = 0; row < height; ++row) squares[row * width + i] = column[row];
  }
  return squares;
}

}  // namespace

GrayClasses gray_classes(const GrayImage& image)
{
  GrayClasses classes{.threshold = otsu_threshold(image.gray)};
  std::array<double, 2> count{}, sum{};
  for (const double gray : image.gray) {
    const std::size_t bright = gray >= classes.threshold;
    count[bright] += 1;
    sum[bright] += gray;
  }
  classes.dark = sum[0] / count[0];
  classes.bright = sum[1] / count[1];
  return classes;
}

GrownWalls grown_walls(const GrayImage& image, const GrayClasses& classes, scene::Wall wall,
                       const std::array<double, 2>& pixel)
{
  std::vector<char> is_wall_pixel(image.gray.size()), is_void(image.gray.size());
  for (std::size_t k = 0; k < image.gray.size(); ++k) {
    is_wall_pixel[k] = is_wall(image.gray[k], classes.threshold, wall);
    is_void[k] = !is_wall_pixel[k];
  }
  const double unit = std::sqrt(pixel[0] * pixel[1]);
  const std::array<double, 2> in_units{pixel[0] / unit, pixel[1] / unit};
  const std::vector<double> to_wall = squared_distances(image, is_wall_pixel, in_units);
  const std::vector<double> to_void = squared_distances(image, is_void, in_units);

  GrownWalls grown;
  grown.image = image;
  const double contrast = classes.bright - classes.dark;
  const double towards = wall == scene::Wall::bright ? 1 : -1;
  grown.per_pixel = -towards * contrast / 2;
  double lowest = infinity;
  for (std::size_t k = 0; k < image.gray.size(); ++k) {
    // The surface lies half a pixel before the centres of the other kind.
    const double depth =
        is_wall_pixel[k] ? std::sqrt(to_void[k]) - 0.5 : 0.5 - std::sqrt(to_wall[k]);
    const double order =
        std::clamp((image.gray[k] - classes.threshold) / contrast, -0.5, 0.5) * towards;
    grown.image.gray[k] = -grown.per_pixel * (depth + order);
    lowest = std::min(lowest, grown.image.gray[k]);
  }
  // No level may be negative, nor a threshold 0.
  grown.surface = 1 - lowest;
  for (double& level : grown.image.gray) level += grown.surface;
  return grown;
}

}  // namespace mpm::micrograph
