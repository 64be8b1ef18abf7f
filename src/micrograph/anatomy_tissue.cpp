#include <mpm/micrograph/anatomy_random.hpp>
#include <mpm/micrograph/anatomy_tissue.hpp>

#include <algorithm>
#include <cmath>

namespace mpm::micrograph::anatomy {

namespace {

/// Radial files between two rays. `bounds` are the edges of the files, from top to bottom.
struct Band {
  std::vector<double> bounds;
  double top() const { return bounds.front(); }
  double bottom() const { return bounds.back(); }
};

struct RayStrip {
  double top, bottom;
};

/// Ducts have so many neighbours that their polygon is nearly round already.
constexpr double duct_roundness = 0.12;

/// A vessel or resin canal: round where x is measured in units of the stretch.
struct Duct {
  Point centre;
  double radius;
  double sheath;  ///< um, diameter of the cells around it
  CellStyle own, around;
};

struct Layout {
  std::vector<Band> bands;
  std::vector<RayStrip> rays;
};

CellStyle blend(const CellKind& early, const CellKind& late, double share)
{
  return {early.wall + share * (late.wall - early.wall),
          early.roundness + share * (late.roundness - early.roundness)};
}

/// Unit vector at an angle given in turns: Taylor series, the same on every machine.
Point direction(double turns)
{
  const double angle = 6.283185307179586 * (turns - std::floor(turns) - 0.5);
  double cosine = 0, sine = 0, term = 1;
  for (int n = 0; n < 28; n += 2) {
    cosine += term;
    term *= angle / (n + 1);
    sine += term;
    term *= -angle / (n + 2);
  }
  return {-cosine, -sine};
}

class Tissue {
 public:
  Tissue(const Parameters& wood, std::uint64_t seed)
      : wood_(wood),
        seed_(seed),
        stretch_(wood.files.stretch),
        margin_(wood.irregularity.wave + wood.irregularity.rim +
                2 * std::max(wood.files.earlywood.radial_pitch, wood.files.tangential_pitch))
  {
  }

  std::vector<Cell> grow()
  {
    lay_out();
    for (const ResinCanal& canal : wood_.resin_canals)
      ducts_.push_back({{canal.x, canal.y},
                        canal.diameter / 2,
                        canal.epithelium,
                        {canal.wall, duct_roundness},
                        {canal.wall, 0.6}});
    if (wood_.vessels) place_vessels(*wood_.vessels);
    Random files(seed_, Stream::files), walls(seed_, Stream::walls), rays(seed_, Stream::rays);
    for (const Band& band : layout_.bands) grow_band(band, files, walls);
    for (const RayStrip& strip : layout_.rays) grow_ray(strip, rays);
    return std::move(cells_);
  }

 private:
  double right() const { return wood_.picture.width + margin_; }
  double bottom() const { return wood_.picture.height + margin_; }

  bool canal_crosses(double top, double bottom) const
  {
    return std::any_of(wood_.resin_canals.begin(), wood_.resin_canals.end(), [&](const auto& c) {
      const double reach = c.diameter / 2 + 2.5 * c.epithelium;
      return top < c.y + reach && bottom > c.y - reach;
    });
  }

  /// Files one below the other; a ray between two files wherever its spacing is used up.
  void lay_out()
  {
    Random random(seed_, Stream::layout);
    const Files& files = wood_.files;
    double y = -margin_;
    double next_ray = wood_.rays ? y + wood_.rays->spacing * random.uniform(0.3, 1) : bottom();
    Band band{{y}};
    while (y < bottom()) {
      y += files.tangential_pitch * (1 + files.tangential_scatter * random.scatter());
      band.bounds.push_back(y);
      if (y < next_ray || y >= bottom()) continue;
      const double height = wood_.rays->rows * wood_.rays->cell_height;
      if (canal_crosses(y, y + height)) continue;
      layout_.bands.push_back(band);
      layout_.rays.push_back({y, y + height});
      y += height;
      band.bounds = {y};
      next_ray = y + wood_.rays->spacing * random.uniform(0.6, 1.4);
    }
    if (band.bounds.size() > 1) layout_.bands.push_back(band);
  }

  double distance(Point a, Point b) const
  {
    const double x = (a.x - b.x) / stretch_, y = a.y - b.y;
    return std::sqrt(x * x + y * y);
  }

  bool fits(const Duct& duct, std::size_t group_start, double gap) const
  {
    const bool inside_band =
        std::any_of(layout_.bands.begin(), layout_.bands.end(), [&](const Band& band) {
          const double reach = duct.radius + 0.75 * duct.sheath;
          return duct.centre.y - reach > band.top() && duct.centre.y + reach < band.bottom();
        });
    if (!inside_band) return false;
    for (std::size_t k = 0; k < group_start; ++k)
      if (distance(ducts_[k].centre, duct.centre) < ducts_[k].radius + duct.radius + gap)
        return false;
    return true;
  }

  /// Vessels alone or in radial rows of two to four that share flattened walls.
  void place_vessels(const Vessels& vessels)
  {
    Random random(seed_, Stream::vessels);
    const double sheath = wood_.files.tangential_pitch;
    const double wanted = vessels.per_mm2 * 1e-6 * (right() + margin_) * (bottom() + margin_);
    const auto drawn = [&](Point centre) {
      const double diameter = random.uniform(vessels.smallest, vessels.largest);
      const double share = latewood_share(wood_.growth_ring, centre.x);
      return Duct{centre,
                  diameter / 2,
                  sheath,
                  {vessels.wall, duct_roundness},
                  blend(wood_.files.earlywood, wood_.files.latewood, share)};
    };
    double placed = 0;
    for (int attempt = 0; attempt < 200000 && placed < wanted; ++attempt) {
      const double x = random.uniform(-margin_, right()), y = random.uniform(-margin_, bottom());
      Duct duct = drawn({x, y});
      const std::size_t group_start = ducts_.size();
      if (!fits(duct, group_start, 1.1 * sheath)) continue;
      ducts_.push_back(duct);
      placed += 1;
      for (int more = 0; more < 3 && random.uniform() < vessels.group_chance; ++more) {
        Duct next = drawn(duct.centre);
        next.centre.x += 0.88 * stretch_ * (duct.radius + next.radius);
        next.centre.y += 0.25 * duct.radius * random.scatter();
        if (!fits(next, group_start, 1.1 * sheath)) break;
        ducts_.push_back(next);
        placed += 1;
        duct = next;
      }
    }
  }

  bool crowded_out(Point at, double reach) const
  {
    return std::any_of(ducts_.begin(), ducts_.end(), [&](const Duct& duct) {
      return distance(duct.centre, at) < duct.radius + reach * duct.sheath;
    });
  }

  CellStyle scattered(CellStyle style, Random& random) const
  {
    style.wall *= 1 + wood_.irregularity.wall * random.scatter();
    return style;
  }

  void grow_band(const Band& band, Random& random, Random& walls)
  {
    std::vector<Site> sites;
    for (std::size_t k = 0; k + 1 < band.bounds.size(); ++k)
      grow_file(band.bounds[k], band.bounds[k + 1], random, sites);
    for (const Duct& duct : ducts_)
      if (duct.centre.y > band.top() && duct.centre.y < band.bottom())
        surround(duct, band, random, sites);
    const std::vector<Cell> grown =
        partition(sites, {-margin_, band.top()}, {right(), band.bottom()}, stretch_,
                  wood_.irregularity.wall, walls);
    cells_.insert(cells_.end(), grown.begin(), grown.end());
  }

  void grow_file(double top, double bottom, Random& random, std::vector<Site>& sites) const
  {
    const Files& files = wood_.files;
    const Irregularity& irregular = wood_.irregularity;
    double x = -margin_ - files.earlywood.radial_pitch * random.uniform();
    while (x < right()) {
      const double share = latewood_share(wood_.growth_ring, x);
      const double pitch = files.earlywood.radial_pitch +
                           share * (files.latewood.radial_pitch - files.earlywood.radial_pitch);
      const double length = pitch * (1 + irregular.size * random.scatter());
      const double height = bottom - top;
      // The shared wall of two flat cells turns and moves the more, the flatter they are.
      const double calm = std::min(1.0, (length * length) / (height * height));
      const double rx = length / (2 * stretch_);
      const double ry = height / 2 * (1 + irregular.size * calm * random.scatter());
      Point at{x + length / 2, (top + bottom) / 2};
      at.x += irregular.position * length * random.scatter();
      at.y += irregular.position * height * calm * random.scatter();
      const CellStyle style = scattered(blend(files.earlywood, files.latewood, share), random);
      if (!crowded_out(at, 1.3)) sites.push_back({at, rx * rx + ry * ry, style});
      x += length;
    }
  }

  /// The duct itself, and a sheath of cells around it.
  void surround(const Duct& duct, const Band& band, Random& random, std::vector<Site>& sites) const
  {
    sites.push_back({duct.centre, duct.radius * duct.radius, duct.own});
    const double r = duct.sheath / 2, ring = duct.radius + r;
    const int count = std::max(5, static_cast<int>(std::floor(6.28 * ring / duct.sheath)));
    const double start = random.uniform();
    for (int k = 0; k < count; ++k) {
      const Point way = direction(start + (k + 0.15 * random.scatter()) / count);
      const double away = ring + 0.1 * r * random.scatter();
      const Point at{duct.centre.x + away * way.x * stretch_, duct.centre.y + away * way.y};
      const CellStyle style = scattered(duct.around, random);
      if (at.y - 0.4 * r < band.top() || at.y + 0.4 * r > band.bottom()) continue;
      if (!crowded_out(at, 0.3)) sites.push_back({at, r * r, style});
    }
  }

  /// Rows of long cells with slanted end walls.
  void grow_ray(const RayStrip& strip, Random& random)
  {
    const Rays& rays = *wood_.rays;
    const double height = (strip.bottom - strip.top) / rays.rows;
    for (int row = 0; row < rays.rows; ++row) {
      const double top = strip.top + row * height, bottom = top + height;
      double x = -margin_ - rays.cell_length * random.uniform();
      double slant = 0;
      while (x < right()) {
        const double length = rays.cell_length * (1 + 0.25 * random.scatter());
        const double next_slant = 0.2 * height * random.scatter();
        const Polygon polygon{{x - slant, top},
                              {x + length - next_slant, top},
                              {x + length + next_slant, bottom},
                              {x + slant, bottom}};
        const CellStyle style = scattered({rays.wall, 0.7, rays.filled}, random);
        cells_.push_back(make_cell(polygon, style, wood_.irregularity.wall, random));
        x += length;
        slant = next_slant;
      }
    }
  }

  const Parameters& wood_;
  std::uint64_t seed_;
  double stretch_, margin_;
  Layout layout_;
  std::vector<Duct> ducts_;
  std::vector<Cell> cells_;
};

}  // namespace

double latewood_share(const GrowthRing& ring, double x)
{
  const double rings = (x - ring.boundary) / ring.width;
  const double into_ring = (rings - std::floor(rings)) * ring.width;
  const double middle = ring.width * (1 - ring.latewood);
  const double t = std::clamp((into_ring - middle) / ring.transition + 0.5, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

std::vector<Cell> grow_tissue(const Parameters& wood, std::uint64_t seed)
{
  return Tissue(wood, seed).grow();
}

}  // namespace mpm::micrograph::anatomy
