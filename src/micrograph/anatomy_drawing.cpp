#include <mpm/core/error.hpp>
#include <mpm/micrograph/anatomy_drawing.hpp>
#include <mpm/micrograph/anatomy_random.hpp>
#include <mpm/micrograph/anatomy_tissue.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace mpm::micrograph::anatomy {

namespace {

/// A place in the tissue seen by one pixel.
struct View {
  Point at;
  std::int32_t cell = 0;
  double depth = -1e30;  ///< um, to the nearest edge of the cell's polygon
};

/// Pixels of a row or column that a location covers, and how much of it.
struct Share {
  int first;
  std::vector<double> weight;
};

std::vector<Share> shares(int pixels, int locations)
{
  std::vector<Share> all;
  for (int k = 0; k < locations; ++k) {
    const double from = double(k) * pixels / locations, to = double(k + 1) * pixels / locations;
    Share share{static_cast<int>(from), {}};
    for (int i = share.first; i < to && i < pixels; ++i)
      share.weight.push_back((std::min(to, i + 1.0) - std::max(from, double(i))) / (to - from));
    all.push_back(share);
  }
  return all;
}

/// Binomial 1-2-1 along rows and columns, ends repeated.
void blur(std::vector<double>& gray, int nx, int ny)
{
  std::vector<double> along(gray.size());
  const auto pass = [](const std::vector<double>& in, std::vector<double>& out, int n, int lines,
                       std::size_t step, std::size_t line_step) {
    for (int line = 0; line < lines; ++line)
      for (int k = 0; k < n; ++k) {
        const std::size_t base = line * line_step, here = base + k * step;
        const double before = in[k > 0 ? here - step : here];
        const double after = in[k + 1 < n ? here + step : here];
        out[here] = (before + 2 * in[here] + after) / 4;
      }
  };
  pass(gray, along, nx, ny, 1, nx);
  pass(along, gray, ny, nx, nx, 1);
}

class Microscope {
 public:
  Microscope(const Parameters& wood, std::uint64_t seed)
      : wood_(wood),
        seed_(seed),
        nx_(wood.picture.width_px),
        ny_(wood.picture.height_px),
        pixel_(wood.picture.width / nx_),
        cells_(grow_tissue(wood, seed)),
        views_(std::size_t(nx_) * ny_)
  {
    bend();
    find_cells();
    overlay();
    if (wood.density) {
      columns_ = shares(nx_, wood.density->lattice_x);
      rows_ = shares(ny_, wood.density->lattice_y);
    }
  }

  /// At the middle of each slice.
  std::vector<std::uint8_t> slices(double depth, int count) const
  {
    const std::vector<double> scale = wall_scale();
    const Grain& grain = *wood_.grain;
    Random random(seed_, Stream::ends);
    std::vector<double> end(cells_.size()), closed(cells_.size());
    for (double& at : end) at = grain.cell_length * random.uniform();
    std::vector<std::uint8_t> gray;
    for (int k = 0; k < count; ++k) {
      const double z = depth * (k + 0.5) / count;
      for (std::size_t c = 0; c < cells_.size(); ++c) {
        const double behind = std::fmod(z + end[c], grain.cell_length);
        const double away = std::min(behind, grain.cell_length - behind);
        closed[c] = std::max(0.0, 1 - away / grain.taper);
      }
      const std::vector<std::uint8_t> slice = expose(scale, closed);
      gray.insert(gray.end(), slice.begin(), slice.end());
    }
    return gray;
  }

  Drawing draw() const
  {
    Drawing drawing;
    drawing.width = nx_;
    drawing.height = ny_;
    drawing.wall_scale = wall_scale();
    drawing.gray = expose(drawing.wall_scale);
    if (wood_.density) drawing.density = densities(drawing.gray);
    drawing.lumens = lumens(drawing.wall_scale);
    return drawing;
  }

 private:
  /// Two smooth displacement fields: files wave over many cells, walls are uneven within one.
  void bend()
  {
    const Irregularity& ir = wood_.irregularity;
    const SmoothField wave_x(seed_, Stream::wave_x, ir.wave_length);
    const SmoothField wave_y(seed_, Stream::wave_y, ir.wave_length);
    const SmoothField rim_x(seed_, Stream::rim_x, ir.rim_length);
    const SmoothField rim_y(seed_, Stream::rim_y, ir.rim_length);
    const double pixel_y = wood_.picture.height / ny_;
    for (int j = 0; j < ny_; ++j)
      for (int i = 0; i < nx_; ++i) {
        const double x = (i + 0.5) * pixel_, y = (j + 0.5) * pixel_y;
        Point& at = views_[std::size_t(j) * nx_ + i].at;
        at.x = x + ir.wave * wave_x(x, y) + ir.rim * rim_x(x, y);
        at.y = y + ir.wave * wave_y(x, y) + ir.rim * rim_y(x, y);
      }
  }

  void find_cells()
  {
    const double reach = wood_.irregularity.wave + wood_.irregularity.rim + pixel_;
    const double pixel_y = wood_.picture.height / ny_;
    const auto clamped = [](double at, int n) {
      return static_cast<int>(std::clamp(std::floor(at), 0.0, double(n)));
    };
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      const Cell& cell = cells_[c];
      const int left = clamped((cell.low.x - reach) / pixel_, nx_);
      const int right = clamped((cell.high.x + reach) / pixel_ + 1, nx_);
      const int top = clamped((cell.low.y - reach) / pixel_y, ny_);
      const int bottom = clamped((cell.high.y + reach) / pixel_y + 1, ny_);
      for (int j = top; j < bottom; ++j)
        for (int i = left; i < right; ++i) {
          View& view = views_[std::size_t(j) * nx_ + i];
          const double depth = cell.depth(view.at);
          if (depth <= view.depth) continue;
          view.depth = depth;
          view.cell = static_cast<std::int32_t>(c);
        }
    }
  }

  /// What does not depend on the walls: noise of every pixel, slow shading, tint of every cell.
  void overlay()
  {
    Random noise(seed_, Stream::noise), tint(seed_, Stream::tint);
    const SmoothField shading(seed_, Stream::shading, wood_.picture.width / 3);
    overlay_.resize(views_.size());
    for (int j = 0; j < ny_; ++j)
      for (int i = 0; i < nx_; ++i)
        overlay_[std::size_t(j) * nx_ + i] =
            wood_.gray.noise * noise.scatter() +
            wood_.gray.shading * shading((i + 0.5) * pixel_, (j + 0.5) * pixel_);
    for (std::size_t c = 0; c < cells_.size(); ++c) tint_.push_back(4 * tint.scatter());
  }

  double scale_at(double x, const std::vector<double>& scale) const
  {
    if (scale.empty()) return 1;
    const auto& windows = wood_.density->windows;
    std::size_t w = 0;
    while (w + 1 < windows.size() && x >= windows[w].to * wood_.picture.width) ++w;
    return scale[w];
  }

  /// `closed`: how far the lumen has narrowed to its end, from 0 to 1.
  double seen(const View& view, double scale, double closed) const
  {
    const Cell& cell = cells_[view.cell];
    const Gray& gray = wood_.gray;
    const double depth = cell.lumen_depth(view.at, scale) - closed * cell.inradius;
    // Secondary electrons leave rims more easily: bright within 2 um of the lumen. The lumen
    // darkens over 8 um, the middle lamella is one pixel wide.
    const double rim = std::max(0.0, 1 - std::abs(depth) / 2);
    const double lamella = std::max(0.0, 1 - view.depth / (0.7 * pixel_));
    const double wall = gray.wall + tint_[view.cell] + gray.edge * rim - gray.lamella * lamella;
    const double lumen = gray.lumen + 2 * tint_[view.cell] + 16 * std::max(0.0, 1 - depth / 8);
    const double open = std::clamp(0.5 + depth / pixel_, 0.0, 1.0);
    return wall + open * (lumen - wall);
  }

  std::vector<std::uint8_t> expose(const std::vector<double>& scale,
                                   const std::vector<double>& closed = {}) const
  {
    std::vector<double> gray(views_.size());
    std::vector<double> scale_of(cells_.size());
    for (std::size_t c = 0; c < cells_.size(); ++c)
      scale_of[c] = scale_at(cells_[c].centre.x, scale);
    for (std::size_t p = 0; p < views_.size(); ++p)
      gray[p] = seen(views_[p], scale_of[views_[p].cell],
                     closed.empty() ? 0 : closed[std::size_t(views_[p].cell)]);
    for (int pass = 0; pass < wood_.gray.blur; ++pass) blur(gray, nx_, ny_);
    std::vector<std::uint8_t> levels(gray.size());
    for (std::size_t p = 0; p < gray.size(); ++p)
      levels[p] = static_cast<std::uint8_t>(
          std::clamp(std::floor(gray[p] + overlay_[p] + 0.5), 0.0, 255.0));
    return levels;
  }

  std::vector<double> densities(const std::vector<std::uint8_t>& gray) const
  {
    const Density& density = *wood_.density;
    std::vector<double> filled(density.windows.size(), 0), all(density.windows.size(), 0);
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const double x = (i + 0.5) / columns_.size();
      for (std::size_t j = 0; j < rows_.size(); ++j) {
        double mean = 0;
        for (std::size_t b = 0; b < rows_[j].weight.size(); ++b)
          for (std::size_t a = 0; a < columns_[i].weight.size(); ++a)
            mean += rows_[j].weight[b] * columns_[i].weight[a] *
                    gray[(rows_[j].first + b) * nx_ + columns_[i].first + a];
        for (std::size_t w = 0; w < density.windows.size(); ++w) {
          if (x < density.windows[w].from || x >= density.windows[w].to) continue;
          all[w] += 1;
          if (mean >= density.threshold) filled[w] += 1;
        }
      }
    }
    for (std::size_t w = 0; w < all.size(); ++w) filled[w] /= std::max(all[w], 1.0);
    return filled;
  }

  /// Bisection for all windows at once; they touch only in the cells on their common border, hence
  /// a second, narrow round.
  std::vector<double> wall_scale() const
  {
    if (!wood_.density) return {};
    const auto& windows = wood_.density->windows;
    std::vector<double> low(windows.size(), 0.2), high(windows.size(), 4);
    std::vector<double> scale(windows.size(), 1);
    for (int round = 0; round < 2; ++round) {
      for (int step = 0; step < 12; ++step) {
        for (std::size_t w = 0; w < windows.size(); ++w) scale[w] = (low[w] + high[w]) / 2;
        const std::vector<double> reached = densities(expose(scale));
        for (std::size_t w = 0; w < windows.size(); ++w)
          (reached[w] < windows[w].relative_density ? low : high)[w] = scale[w];
      }
      for (std::size_t w = 0; w < windows.size(); ++w) {
        low[w] = 0.97 * scale[w];
        high[w] = 1.03 * scale[w];
      }
    }
    const std::vector<double> reached = densities(expose(scale));
    for (std::size_t w = 0; w < windows.size(); ++w)
      if (std::abs(reached[w] - windows[w].relative_density) > 0.005)
        throw InputError(
            fmt::format("{}: density.windows[{}].relative_density is {:g} (walls scaled by {:.2f} "
                        "reach {:.3f}). "
                        "Change the wall or pitch of the cells there, or the density.",
                        wood_.file.string(), w, windows[w].relative_density, scale[w], reached[w]));
    return scale;
  }

  std::vector<Point> lumens(const std::vector<double>& scale) const
  {
    struct Deepest {
      double depth = 0;
      std::size_t pixel = 0;
    };
    std::vector<Deepest> deepest(cells_.size());
    for (std::size_t p = 0; p < views_.size(); ++p) {
      const Cell& cell = cells_[views_[p].cell];
      const double depth = cell.lumen_depth(views_[p].at, scale_at(cell.centre.x, scale));
      Deepest& so_far = deepest[views_[p].cell];
      if (depth > so_far.depth) so_far = {depth, p};
    }
    std::vector<Point> found;
    for (const Deepest& d : deepest)
      if (d.depth > pixel_)
        found.push_back({static_cast<double>(d.pixel % nx_), static_cast<double>(d.pixel / nx_)});
    return found;
  }

  const Parameters& wood_;
  std::uint64_t seed_;
  int nx_, ny_;
  double pixel_;
  std::vector<Cell> cells_;
  std::vector<View> views_;
  std::vector<double> overlay_;  ///< gray added to each pixel
  std::vector<double> tint_;     ///< gray added to each cell
  std::vector<Share> columns_, rows_;
};

}  // namespace

Drawing draw(const Parameters& wood, std::uint64_t seed)
{
  return Microscope(wood, seed).draw();
}

std::vector<std::uint8_t> draw_slices(const Parameters& wood, std::uint64_t seed, double depth,
                                      int slices)
{
  return Microscope(wood, seed).slices(depth, slices);
}

}  // namespace mpm::micrograph::anatomy
