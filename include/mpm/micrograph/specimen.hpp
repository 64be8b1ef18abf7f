#pragma once
/// From a scene's specimen (an image or shapes) to its particle locations.

#include <mpm/micrograph/lattice.hpp>
#include <mpm/micrograph/location_source.hpp>
#include <mpm/micrograph/picture.hpp>
#include <mpm/micrograph/share.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mpm::micrograph {

struct RelativeDensity {
  std::string window;   ///< "" for the whole specimen
  double value;         ///< filled locations / locations
  double bulk_density;  ///< kg/m^3
};

/// What fills each location, without holding them: any part can be rastered at any time. What is
/// known of the whole was counted by all parts together, each its slab. A location counts in a
/// window where its centre lies.
template <int Dim>
class Specimen {
 public:
  /// `picture`: as read_picture returns it. Collective. Throws InputError on all parts or on none
  /// (no wall found, impossible shapes, too many locations).
  Specimen(const scene::Scene& scene, std::optional<Picture> picture, const Share& share = {});

  const Vec<Dim>& size() const { return size_; }  ///< m
  const IndexVec<Dim>& cells() const { return cells_; }
  int particles_per_cell() const { return particles_per_cell_; }  ///< per direction
  /// Locations along each axis, cells x particles per cell, and the box of all of them.
  const IndexVec<Dim>& count() const { return count_; }
  IndexBox<Dim> whole() const { return {IndexVec<Dim>::Zero(), count_}; }
  GlobalIndex locations() const { return whole().size(); }

  GlobalIndex particles() const;  ///< filled locations
  /// Per entry of scene.materials.
  const std::vector<GlobalIndex>& particles_of_material() const { return particles_of_material_; }
  /// Whole specimen first, then the windows.
  const std::vector<RelativeDensity>& densities() const { return densities_; }
  /// m/s, largest component of a deformable particle's initial velocity.
  double largest_initial_speed() const { return largest_initial_speed_; }
  /// Nothing for shapes.
  const std::optional<PictureFigures>& picture() const { return picture_; }

  /// Rasters a part of the lattice. Not collective; any part may ask for any box of locations.
  Lattice<Dim> lattice(const IndexBox<Dim>& part) const;
  /// Where it is wall, finer than that. `periodic`: along x and y.
  std::unique_ptr<WallPlaces<Dim>> wall_places(const std::array<bool, 2>& periodic) const
  {
    return source_->wall_places(count_, periodic);
  }

 private:
  void settle_picture(const scene::Scene& scene, Picture picture, const Share& share);
  void settle_shapes(const scene::Scene& scene, const Share& share);
  void settle_grid(const scene::Scene& scene, const Share& share);
  /// Where the scene gives them by formulas. Throws on all parts if one is no number somewhere.
  void settle_speeds(const scene::Scene& scene, const Share& share);
  /// Throws on all parts for a shape that contains no location.
  void check_found(const std::vector<double>& found) const;

  Vec<Dim> size_;
  IndexVec<Dim> cells_, count_;
  int particles_per_cell_ = 1;
  std::vector<GlobalIndex> particles_of_material_;
  std::vector<RelativeDensity> densities_;
  double largest_initial_speed_ = 0;
  std::optional<PictureFigures> picture_;
  std::unique_ptr<const LocationSource<Dim>> source_;
};

extern template class Specimen<2>;
extern template class Specimen<3>;

}  // namespace mpm::micrograph
