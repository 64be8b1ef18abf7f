#include <mpm/scene/schema.hpp>

namespace mpm::scene {

enum class Rotation { none, quarter, half, three_quarters };
template <>
inline constexpr auto names_of<Rotation> =
    std::to_array<Named<Rotation>>({{Rotation::none, "0"},
                                    {Rotation::quarter, "90"},
                                    {Rotation::half, "180"},
                                    {Rotation::three_quarters, "270"}});

enum class Flip { none, horizontal, vertical, both };
template <>
inline constexpr auto names_of<Flip> = std::to_array<Named<Flip>>({{Flip::none, "none"},
                                                                   {Flip::horizontal, "horizontal"},
                                                                   {Flip::vertical, "vertical"},
                                                                   {Flip::both, "both"}});

/// `threshold` as written: a gray level, `otsu`, or a map with the density aimed at, relative or in
/// kg/m^3.
struct ThresholdKey {
  ThresholdRule rule = ThresholdRule::value;
  double value = 0;
};

namespace {

constexpr Bound gray_level = from_to(0, 255);
constexpr Bound gray_shift = from_to(-255, 255);
constexpr Bound relative_density = between(0, 1);
const std::string share_key = "target_relative_density";
const std::string density_key = "target_density";

const Condition<Specimen> from_image{[](const Specimen& s) { return s.micrograph.has_value(); },
                                     "a specimen with a micrograph"};
const Condition<Specimen> without_bands{
    [](const Specimen& s) { return s.micrograph && s.micrograph->bands.empty(); },
    "a micrograph without bands"};
const Condition<Specimen> from_drawing{
    [](const Specimen& s) { return s.micrograph && s.micrograph->is_drawn(); },
    "a micrograph that is drawn (*.anatomy.yaml)"};
const Condition<Specimen> from_shapes{[](const Specimen& s) { return !s.micrograph; },
                                      "a specimen without a micrograph"};

Micrograph image(const Specimen& specimen)
{
  return specimen.micrograph.value_or(Micrograph{});
}

template <class T>
Parameter<Specimen> image_member(std::string key, T Micrograph::*pointer, const Traits& traits,
                                 std::string help)
{
  return property<T, Specimen>(
             std::move(key), [pointer](const Specimen& s) { return image(s).*pointer; },
             [pointer](Specimen& s, T value) { (*s.micrograph).*pointer = std::move(value); },
             traits, std::move(help))
      .when(from_image);
}

}  // namespace

template <>
struct Value<ThresholdKey> {
  /// What a density that is aimed at may be.
  static Rule aim(ThresholdRule rule)
  {
    if (rule == ThresholdRule::target_density) return {Quantity::density, above(0)};
    return {Quantity::fraction, relative_density};
  }
  static bool read(const Given& given, const Rule& rule, ThresholdKey& key)
  {
    if (given.node.kind == Node::Kind::scalar && given.node.scalar == "otsu") {
      key = {ThresholdRule::otsu, 0};
      return true;
    }
    if (given.node.kind == Node::Kind::map) {
      if (!check_keys(given, {share_key, density_key}).empty()) return false;
      const Entry* share = given.node.find(share_key);
      const Entry* density = given.node.find(density_key);
      if ((share == nullptr) == (density == nullptr))
        return given.refuse("needs one of the keys " + share_key + " and " + density_key);
      key.rule = share ? ThresholdRule::target_relative_density : ThresholdRule::target_density;
      return Value<double>::read(given.entry(share ? *share : *density), aim(key.rule), key.value);
    }
    key.rule = ThresholdRule::value;
    if (given.node.kind != Node::Kind::scalar || !split_number_and_unit(given.node.scalar))
      return given.refuse("must be a gray level of 0 to 255, otsu, {" + share_key + ": ...} or {" +
                          density_key + ": ...}");
    return Value<double>::read(given, rule, key.value);
  }
  static Node write(const ThresholdKey& key, const Rule& rule)
  {
    if (key.rule == ThresholdRule::otsu) return Node::of("otsu");
    if (key.rule == ThresholdRule::value) return Value<double>::write(key.value, rule);
    Node node;
    node.kind = Node::Kind::map;
    node.entries.push_back({key.rule == ThresholdRule::target_density ? density_key : share_key,
                            {},
                            Value<double>::write(key.value, aim(key.rule))});
    return node;
  }
  static std::string describe(const Rule&)
  {
    return "a gray level of 0 to 255, `otsu`, `{" + share_key + ": 0.4}` or `{" + density_key +
           ": 450 kg/m^3}`";
  }
  static Json schema(const Rule& rule)
  {
    Json any{words_schema({"otsu"}), Value<double>::schema(rule)};
    for (const ThresholdRule aimed :
         {ThresholdRule::target_relative_density, ThresholdRule::target_density}) {
      const std::string& key = aimed == ThresholdRule::target_density ? density_key : share_key;
      Json map{{"type", "object"}, {"additionalProperties", false}, {"required", {key}}};
      map["properties"][key] = Value<double>::schema(aim(aimed));
      any.push_back(std::move(map));
    }
    return {{"anyOf", std::move(any)}};
  }
};

namespace {

ThresholdKey threshold_key(const Specimen& s)
{
  const Micrograph m = image(s);
  switch (m.threshold_rule) {
    case ThresholdRule::target_relative_density:
      return {m.threshold_rule, m.target_relative_density};
    case ThresholdRule::target_density:
      return {m.threshold_rule, m.target_density};
    default:
      return {m.threshold_rule, m.threshold};
  }
}

void set_threshold(Specimen& s, ThresholdKey key)
{
  s.micrograph->threshold_rule = key.rule;
  if (key.rule == ThresholdRule::value) s.micrograph->threshold = key.value;
  if (key.rule == ThresholdRule::target_relative_density)
    s.micrograph->target_relative_density = key.value;
  if (key.rule == ThresholdRule::target_density) s.micrograph->target_density = key.value;
}

}  // namespace

template <>
const std::vector<Parameter<Specimen>>& parameters<Specimen>()
{
  using enum Quantity;
  using S = Specimen;
  using I = Micrograph;
  static const std::vector<Parameter<S>> rows{
      property<std::optional<std::filesystem::path>, S>(
          "micrograph",
          [](const S& s) {
            return s.micrograph ? std::optional(s.micrograph->file) : std::nullopt;
          },
          [](S& s, auto file) { s.micrograph.emplace().file = *file; },
          {.decides = true, .default_text = "none"},
          "picture of a section: BMP, PNG or TIFF, gray or colour; or how to draw one: "
          "*.anatomy.yaml; with depth also a stack of slices: a TIFF of many pages, or all files "
          "that fit a name such as `slice_*.png`, the first at the back"),
      image_member("seed", &I::seed, {.bound = at_least(0), .default_text = "that of the file"},
                   "another piece of the same kind of wood")
          .when(from_drawing),
      image_member("image_size", &I::image_size,
                   {.quantity = length,
                    .bound = above(0),
                    .default_text = "from pixel_size, the TIFF's resolution or the drawing"},
                   "width and height of the whole picture as stored"),
      image_member("pixel_size", &I::pixel_size,
                   {.quantity = length,
                    .bound = above(0),
                    .spread = true,
                    .default_text = "from image_size, the TIFF's resolution or the drawing",
                    .excludes = "image_size"},
                   "width and height of a pixel"),
      image_member(
          "depth", &I::depth,
          {.quantity = length, .bound = above(0), .default_text = "none: in the plane"},
          "makes a scene in space: the picture drawn out along z, or the thickness of a whole "
          "stack"),
      image_member("crop", &I::crop, {.bound = at_least(0), .default_text = "whole picture"},
                   "part to use, in pixels of the file: x, y (from the top), width, height"),
      property<Rotation, S>(
          "rotate", [](const S& s) { return static_cast<Rotation>(image(s).rotate / 90); },
          [](S& s, Rotation turn) { s.micrograph->rotate = 90 * static_cast<int>(turn); }, {},
          "degrees counter-clockwise, after the crop")
          .when(from_image),
      property<Flip, S>(
          "flip",
          [](const S& s) {
            const I m = image(s);
            return static_cast<Flip>((m.flip_horizontal ? 1 : 0) + (m.flip_vertical ? 2 : 0));
          },
          [](S& s, Flip flip) {
            s.micrograph->flip_horizontal = flip == Flip::horizontal || flip == Flip::both;
            s.micrograph->flip_vertical = flip == Flip::vertical || flip == Flip::both;
          },
          {}, "left and right, or top and bottom exchanged, after the rotation")
          .when(from_image),
      image_member("bands", &I::bands,
                   {.decides = true, .default_text = "none: one material by threshold"},
                   "several materials by gray level; gray outside all bands is void"),
      image_member("wall", &I::wall, {}, "whether the cell wall is the bright or the dark part")
          .when(without_bands),
      property<ThresholdKey, S>("threshold", threshold_key, set_threshold, {.bound = gray_level},
                                "gray level that separates cell wall and lumen")
          .when(without_bands),
      property<std::optional<double>, S>(
          share_key, [](const S&) { return std::optional<double>{}; },
          [](S& s, auto density) {
            set_threshold(s, {ThresholdRule::target_relative_density, *density});
          },
          {.quantity = fraction,
           .bound = relative_density,
           .default_text = "none",
           .excludes = "threshold"},
          "choose the threshold that gives this relative density")
          .when(without_bands),
      image_member("threshold_shift", &I::threshold_shift, {.bound = gray_shift},
                   "gray levels added to the threshold, also to one that was found: what a figure "
                   "owes to it")
          .when(without_bands),
      image_member("sampling", &I::sampling, {},
                   "match: the particles have the picture's density (with bands that of every "
                   "material) at every resolution; threshold: a location is wall if its mean gray "
                   "reaches the threshold"),
      image_member(
          "remove_specks", &I::remove_specks, {.bound = at_least(0)},
          "pieces of wall with fewer particle locations (of a picture drawn out: of a layer across "
          "z) than this become void"),
      image_member("remove_unconnected", &I::remove_unconnected, {},
                   "keep only what is connected to the largest piece"),
      member<S>("size", &S::size, {.quantity = length, .bound = above(0), .default_text = "none"},
                "width and height of a specimen made of shapes; a third one, the depth, makes a "
                "scene in space")
          .when(from_shapes),
      member<S>("shapes", &S::shapes, {.default_text = "none"},
                "drawn in order; later ones override earlier ones")
          .when(from_shapes),
      member<S>("initial_velocity", &S::initial_velocity,
                {.quantity = Quantity::velocity, .default_text = "the shapes' own"},
                "of all that can be deformed, by the place at t = 0"),
      member<S>("windows", &S::windows, {.default_text = "none"},
                "parts whose relative density is reported"),
  };
  return rows;
}

template <>
const std::vector<Parameter<GrayBand>>& parameters<GrayBand>()
{
  using B = GrayBand;
  static const std::vector<Parameter<B>> rows{
      member<B>("from", &B::from, {.bound = from_to(0, 256), .need = Need::required},
                "lowest gray level"),
      member<B>("to", &B::to, {.bound = from_to(0, 256), .need = Need::required},
                "gray level above the highest"),
      member<B>("material", &B::material, {.need = Need::required}, "name of a material"),
  };
  return rows;
}

template <>
const std::vector<Parameter<Window>>& parameters<Window>()
{
  using W = Window;
  const Traits part{.quantity = Quantity::fraction, .bound = from_to(0, 1)};
  static const std::vector<Parameter<W>> rows{
      member<W>("name", &W::name, {.need = Need::required}, "shown with the density"),
      member<W>("x", &W::x, part, "from and to, as fractions of the width"),
      member<W>("y", &W::y, part, "from (below) and to, as fractions of the height"),
      member<W>("z", &W::z, part, "from (the back) and to, as fractions of the depth").in_space(),
  };
  return rows;
}

}  // namespace mpm::scene
