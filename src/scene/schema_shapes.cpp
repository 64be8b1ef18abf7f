#include <mpm/scene/schema.hpp>

namespace mpm::scene {

namespace {

template <class Kind>
Parameter<Shape> geometry()
{
  auto row = property<std::optional<Kind>, Shape>(
      std::string(Kind::keyword),
      [](const Shape& shape) {
        const Kind* held = std::get_if<Kind>(&shape.geometry);
        return held != nullptr ? std::optional(*held) : std::nullopt;
      },
      [](Shape& shape, std::optional<Kind> value) { shape.geometry = std::move(*value); },
      {.default_text = "none"}, std::string(Kind::help));
  if (!lies_in<Kind>(3)) return std::move(row).in_plane();
  if (!lies_in<Kind>(2)) return std::move(row).in_space();
  return row;
}

}  // namespace

std::vector<std::string> shape_keywords(int dimensions)
{
  std::vector<std::string> words;
  for_each_kind([&]<class Kind>(std::type_identity<Kind>) {
    if (lies_in<Kind>(dimensions)) words.emplace_back(Kind::keyword);
  });
  return words;
}

template <>
const std::vector<Parameter<Shape>>& parameters<Shape>()
{
  static const std::vector<Parameter<Shape>> rows = [] {
    std::vector<Parameter<Shape>> list;
    for_each_kind([&]<class Kind>(std::type_identity<Kind>) { list.push_back(geometry<Kind>()); });
    list.push_back(
        member<Shape>("material", &Shape::material, {.default_text = "the first material"},
                      "name of a material, or `void` to cut a hole into earlier shapes"));
    list.push_back(member<Shape>("velocity", &Shape::velocity, {.quantity = Quantity::velocity},
                                 "initial velocity [x, y], in space [x, y, z]"));
    return list;
  }();
  return rows;
}

}  // namespace mpm::scene
