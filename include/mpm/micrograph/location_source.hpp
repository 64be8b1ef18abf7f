#pragma once
/// What fills the locations of a specimen: shapes, or a picture.

#include <mpm/micrograph/lattice.hpp>
#include <mpm/micrograph/section.hpp>
#include <mpm/micrograph/wall_places.hpp>

#include <array>
#include <span>
#include <vector>

namespace mpm::micrograph {

template <int Dim>
class LocationSource {
 public:
  virtual ~LocationSource() = default;
  /// Fills a lattice whose count and part are set. Not collective.
  virtual void fill(Lattice<Dim>& lattice) const = 0;
  /// What the locations are taken from; `count` of them cover the specimen. `periodic`: x and y.
  virtual std::unique_ptr<WallPlaces<Dim>> wall_places(
      const IndexVec<Dim>& count, const std::array<bool, 2>& periodic) const = 0;
};

/// A location belongs to the last shape that contains its centre.
template <int Dim>
class ShapeSource : public LocationSource<Dim> {
 public:
  /// Throws InputError (no or impossible shapes, unknown materials).
  ShapeSource(const scene::Scene& scene, const Vec<Dim>& size);

  void fill(Lattice<Dim>& lattice) const override { fill(lattice, {}); }
  std::unique_ptr<WallPlaces<Dim>> wall_places(const IndexVec<Dim>& count,
                                               const std::array<bool, 2>&) const override
  {
    return places_of_shapes<Dim>(shapes_, materials_, size_, count);
  }
  /// Marks the shapes that contain the centre of a location, if there are marks.
  void fill(Lattice<Dim>& lattice, std::span<double> found) const;
  /// Index into scene.materials, or Lattice::empty, of what a shape is made of.
  std::int8_t material(std::size_t shape) const { return materials_[shape]; }

 private:
  Vec<Dim> size_;
  std::vector<scene::Shape> shapes_;
  std::vector<std::int8_t> materials_;
};

/// A section drawn out along z.
template <int Dim>
class PictureSource : public LocationSource<Dim> {
 public:
  explicit PictureSource(Section<2> section) : section_(std::move(section)) {}
  void fill(Lattice<Dim>& lattice) const override;
  std::unique_ptr<WallPlaces<Dim>> wall_places(const IndexVec<Dim>& count,
                                               const std::array<bool, 2>& periodic) const override
  {
    const GrayImage& image = section_.image();
    return places_of_picture<Dim>(
        {image.width, image.height, section_.wall_levels(), section_.figures().density}, count,
        periodic);
  }

 private:
  Section<2> section_;
};

/// A stack of slices.
class StackSource final : public LocationSource<3> {
 public:
  explicit StackSource(Section<3> stack) : stack_(std::move(stack)) {}
  void fill(Lattice<3>& lattice) const override
  {
    lattice.material = stack_.materials(lattice.part);
    lattice.shape.clear();
  }
  /// Surfaces are not fitted in space: nobody asks.
  std::unique_ptr<WallPlaces<3>> wall_places(const IndexVec<3>&,
                                             const std::array<bool, 2>&) const override
  {
    return nullptr;
  }

 private:
  Section<3> stack_;
};

extern template class ShapeSource<2>;
extern template class ShapeSource<3>;
extern template class PictureSource<2>;
extern template class PictureSource<3>;

}  // namespace mpm::micrograph
