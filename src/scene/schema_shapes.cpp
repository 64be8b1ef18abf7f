#include <mpm/scene/schema.hpp>

namespace mpm::scene {

namespace {

template <class Geometry>
Parameter<Shape> geometry(std::string key, std::string help)
{
  return property<std::optional<Geometry>, Shape>(
      std::move(key),
      [](const Shape& shape) {
        const Geometry* held = std::get_if<Geometry>(&shape.geometry);
        return held != nullptr ? std::optional(*held) : std::nullopt;
      },
      [](Shape& shape, std::optional<Geometry> value) { shape.geometry = std::move(*value); },
      {.default_text = "none"}, std::move(help));
}

const Traits coordinates{.quantity = Quantity::length, .need = Need::required};
const Traits extent{.quantity = Quantity::length, .bound = above(0), .need = Need::required};

}  // namespace

template <>
const std::vector<Parameter<Shape>>& parameters<Shape>()
{
  static const std::vector<Parameter<Shape>> rows{
      geometry<Box>("box", "rectangle; a shape is one of box, disc, polygon, honeycomb"),
      geometry<Disc>("disc", "full circle"),
      geometry<Polygon>("polygon", "closed by itself, inside by the even-odd rule"),
      geometry<Honeycomb>("honeycomb", "regular hexagons that fill a rectangle"),
      member<Shape>("material", &Shape::material, {.default_text = "the first material"},
                    "name of a material, or `void` to cut a hole into earlier shapes"),
      member<Shape>("velocity", &Shape::velocity, {.quantity = Quantity::velocity},
                    "initial velocity [x, y]"),
  };
  return rows;
}

template <>
const std::vector<Parameter<Box>>& parameters<Box>()
{
  static const std::vector<Parameter<Box>> rows{
      member<Box>("lower", &Box::lower, coordinates, "lower left corner [x, y]"),
      member<Box>("upper", &Box::upper, coordinates, "upper right corner [x, y]"),
  };
  return rows;
}

template <>
const std::vector<Parameter<Disc>>& parameters<Disc>()
{
  static const std::vector<Parameter<Disc>> rows{
      member<Disc>("centre", &Disc::centre, coordinates, "[x, y]"),
      member<Disc>("radius", &Disc::radius, extent, "radius"),
  };
  return rows;
}

template <>
const std::vector<Parameter<Polygon>>& parameters<Polygon>()
{
  static const std::vector<Parameter<Polygon>> rows{
      member<Polygon>("vertices", &Polygon::vertices, coordinates, "list of corners [x, y]"),
  };
  return rows;
}

template <>
const std::vector<Parameter<Honeycomb>>& parameters<Honeycomb>()
{
  using H = Honeycomb;
  static const std::vector<Parameter<H>> rows{
      member<H>("lower", &H::lower, coordinates, "lower left corner [x, y]"),
      member<H>("upper", &H::upper, coordinates, "upper right corner [x, y]"),
      member<H>("cell_side", &H::cell_side, extent, "centre-line length of a hexagon's side"),
      member<H>("wall_thickness", &H::wall_thickness, extent, "thickness of the walls"),
  };
  return rows;
}

}  // namespace mpm::scene
