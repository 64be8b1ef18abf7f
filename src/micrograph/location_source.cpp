#include <mpm/core/error.hpp>
#include <mpm/micrograph/location_source.hpp>
#include <mpm/micrograph/material_names.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace mpm::micrograph {

namespace {

/// The locations of a part whose centres can lie in a shape's extent (m); one more on either side,
/// so that rounding here decides nothing.
template <int Dim>
IndexBox<Dim> locations_in(const scene::Extent& extent, const Vec<Dim>& size,
                           const Lattice<Dim>& lattice)
{
  IndexBox<Dim> box = lattice.part;
  for (int d = 0; d < Dim; ++d) {
    const auto axis = std::size_t(d);
    const double first = std::floor(extent.lower[axis] / size[d] * lattice.count[d]) - 1;
    const double last = std::ceil(extent.upper[axis] / size[d] * lattice.count[d]) + 1;
    const double lower = lattice.part.lower[d], upper = lattice.part.upper[d];
    box.lower[d] = LocalIndex(std::clamp(first, lower, upper));
    box.upper[d] = LocalIndex(std::clamp(last, lower, upper));
  }
  return box;
}

/// visit(first location of the row, point on the row) for each row of a box.
template <int Dim, class Visit>
void for_each_row(const IndexBox<Dim>& box, const Vec<Dim>& size, const IndexVec<Dim>& count,
                  Visit visit)
{
  if (box.empty()) return;
  IndexBox<Dim> starts = box;
  starts.upper[0] = box.lower[0] + 1;
  for_each_index(starts, [&](const IndexVec<Dim>& start) {
    scene::Point<Dim> point{};
    for (int d = 1; d < Dim; ++d) point[std::size_t(d)] = centre(start[d], count[d]) * size[d];
    visit(start, point);
  });
}

/// Fills the locations that a shape contains; returns whether there are any.
template <int Dim, class Kind>
bool draw(const Kind& kind, const Vec<Dim>& size, std::int8_t material, std::int16_t number,
          Lattice<Dim>& lattice)
{
  const IndexBox<Dim> box = locations_in(kind.extent(), size, lattice);
  const auto width = std::size_t(box.count()[0]);
  std::vector<double> x(width);
  for (std::size_t i = 0; i < width; ++i)
    x[i] = centre(box.lower[0] + int(i), lattice.count[0]) * size[0];
  std::vector<char> inside(width);
  bool found = false;
  for_each_row(box, size, lattice.count, [&](const IndexVec<Dim>& start, scene::Point<Dim> point) {
    for (std::size_t i = 0; i < width; ++i) {
      point[0] = x[i];
      inside[i] = kind.contains(point);
    }
    const std::size_t first = lattice.place(start);
    std::int8_t* materials = &lattice.material[first];
    std::int16_t* shapes = &lattice.shape[first];
    char any = 0;
    for (std::size_t i = 0; i < width; ++i) {
      materials[i] = inside[i] ? material : materials[i];
      shapes[i] = inside[i] ? number : shapes[i];
      any |= inside[i];
    }
    found = found || any;
  });
  return found;
}

}  // namespace

template <int Dim>
ShapeSource<Dim>::ShapeSource(const scene::Scene& scene, const Vec<Dim>& size)
    : size_(size), shapes_(scene.specimen.shapes)
{
  constexpr auto most = std::size_t(std::numeric_limits<std::int16_t>::max());
  if (shapes_.size() > most)
    throw InputError(fmt::format("specimen.shapes has {} entries. At most {} can be told apart.",
                                 shapes_.size(), most));
  const MaterialNames names(scene.materials);
  for (std::size_t number = 0; number < shapes_.size(); ++number) {
    const scene::Shape& shape = shapes_[number];
    const std::string key = fmt::format("specimen.shapes[{}]", number);
    std::visit(
        [&]<class Kind>(const Kind& kind) {
          if (!scene::lies_in<Kind>(Dim))
            throw InputError(fmt::format("{} is a {}, which has no place in {}.", key,
                                         Kind::keyword, Dim == 2 ? "the plane" : "space"));
          if (const auto defect = kind.defect(Dim))
            throw InputError(
                fmt::format("{}.{}.{}: {}.", key, Kind::keyword, defect->key, defect->reason));
        },
        shape.geometry);
    materials_.push_back(names.index(shape.material, key + ".material"));
  }
}

template <int Dim>
void ShapeSource<Dim>::fill(Lattice<Dim>& lattice, std::span<double> found) const
{
  const auto locations = std::size_t(lattice.part.size());
  lattice.material.assign(locations, Lattice<Dim>::empty);
  lattice.shape.assign(locations, -1);
  for (std::size_t number = 0; number < shapes_.size(); ++number) {
    const std::int8_t material = materials_[number];
    const std::int16_t label = material == Lattice<Dim>::empty ? -1 : std::int16_t(number);
    std::visit(
        [&]<class Kind>(const Kind& kind) {
          if constexpr (scene::lies_in<Kind>(Dim)) {
            const bool any = draw<Dim>(kind, size_, material, label, lattice);
            if (any && !found.empty()) found[number] = 1;
          }
        },
        shapes_[number].geometry);
  }
}

template <int Dim>
void PictureSource<Dim>::fill(Lattice<Dim>& lattice) const
{
  const IndexBox<Dim>& part = lattice.part;
  lattice.material.clear();
  lattice.shape.clear();
  if (part.empty()) return;
  const std::vector<std::int8_t> layer =
      section_.materials({part.lower.template head<2>(), part.upper.template head<2>()});
  lattice.material.reserve(std::size_t(part.size()));
  while (lattice.material.size() < std::size_t(part.size()))
    lattice.material.insert(lattice.material.end(), layer.begin(), layer.end());
}

template class ShapeSource<2>;
template class ShapeSource<3>;
template class PictureSource<2>;
template class PictureSource<3>;

}  // namespace mpm::micrograph
