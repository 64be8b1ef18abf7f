#include <mpm/core/nearest_name.hpp>

#include <cmath>

#include "checks.hpp"
#include <fmt/format.h>

namespace mpm::scene {

namespace {

using Corner = std::array<double, 2>;

bool is_below(const Corner& lower, const Corner& upper)
{
  return lower[0] < upper[0] && lower[1] < upper[1];
}

/// `others`: names that stand for no material but may be used.
void check_name(const Checked& checked, const std::string& path, const std::string& name,
                const std::vector<std::string>& others = {})
{
  std::vector<std::string> names = checked.material_names();
  if (names.empty() || !checked.given(path)) return;
  names.insert(names.end(), others.begin(), others.end());
  if (std::ranges::find(names, name) == names.end())
    checked.refuse(path, "no such material; " + suggestion(name, names));
}

void check_bands(const Checked& checked, const std::vector<GrayBand>& bands)
{
  for (std::size_t i = 0; i < bands.size(); ++i) {
    const std::string path = fmt::format("specimen.bands[{}]", i);
    check_name(checked, path + ".material", bands[i].material);
    if (!checked.sound(path)) continue;
    if (bands[i].from >= bands[i].to)
      checked.refuse(path + ".from", fmt::format("must be below to, {}", bands[i].to));
    for (std::size_t j = 0; j < i; ++j) {
      if (bands[i].from < bands[j].to && bands[j].from < bands[i].to)
        checked.refuse(path + ".from", fmt::format("overlaps bands[{}] from {} to {}", j,
                                                   bands[j].from, bands[j].to));
    }
  }
}

void check_micrograph(const Checked& checked, const Micrograph& micrograph)
{
  std::error_code ignored;
  if (!std::filesystem::exists(micrograph.file, ignored))
    checked.refuse("specimen.micrograph", "no such file: " + micrograph.file.string(),
                   "Give the path from the scene's folder");
  else if (!std::filesystem::is_regular_file(micrograph.file, ignored))
    checked.refuse("specimen.micrograph", micrograph.file.string() + " is not a file",
                   "Name a BMP, PNG or TIFF picture");

  checked.both_given("specimen.pixel_size", "specimen.image_size");
  checked.both_given("specimen.target_relative_density", "specimen.threshold");
  if (micrograph.crop) {
    for (const int i : {2, 3}) {
      if ((*micrograph.crop)[static_cast<std::size_t>(i)] < 1)
        checked.refuse(fmt::format("specimen.crop[{}]", i),
                       fmt::format("the {} must be at least 1 pixel", i == 2 ? "width" : "height"));
    }
  }
  check_bands(checked, micrograph.bands);
}

/// Each overload says what is impossible about one kind of shape.
struct GeometryCheck {
  const Checked& checked;
  std::string path;

  void corners(const std::string& key, const Corner& lower, const Corner& upper) const
  {
    if (checked.sound(path + key) && !is_below(lower, upper))
      checked.refuse(path + key + ".upper", "must be right of and above lower");
  }
  void operator()(const Box& box) const { corners(".box", box.lower, box.upper); }
  void operator()(const Disc&) const {}
  void operator()(const Polygon& polygon) const
  {
    if (polygon.vertices.size() < 3)
      checked.refuse(path + ".polygon.vertices", "a polygon has at least 3 vertices");
  }
  void operator()(const Honeycomb& comb) const
  {
    corners(".honeycomb", comb.lower, comb.upper);
    const std::string thickness = path + ".honeycomb.wall_thickness";
    if (comb.wall_thickness >= std::sqrt(3.0) * comb.cell_side && checked.sound(path))
      checked.refuse(thickness, "must be below sqrt(3) cell_side, or no lumen is left");
  }
};

void check_shapes(const Checked& checked)
{
  const Specimen& specimen = checked.scene.specimen;
  if (!checked.given("specimen.shapes")) {
    if (checked.sound("specimen.shapes"))
      checked.miss("specimen.micrograph", "what the specimen looks like",
                   "Add micrograph: FILE, or size: [WIDTH, HEIGHT] and shapes");
    return;
  }
  if (!checked.given("specimen.size"))
    checked.miss("specimen.size", "shapes lie in a rectangle of this size",
                 "Add e.g. size: [1 mm, 1 mm]");
  if (checked.given("specimen.shapes") && specimen.shapes.empty())
    checked.refuse("specimen.shapes", "a specimen needs at least one");

  for (std::size_t i = 0; i < specimen.shapes.size(); ++i) {
    const std::string path = fmt::format("specimen.shapes[{}]", i);
    std::vector<std::string> kinds;
    for (const char* kind : {"box", "disc", "polygon", "honeycomb"})
      if (checked.given(path + "." + kind)) kinds.emplace_back(kind);
    if (kinds.size() == 1)
      std::visit(GeometryCheck{checked, path}, specimen.shapes[i].geometry);
    else if (kinds.empty())
      checked.miss(path + ".box", "what the shape is", "Add box, disc, polygon or honeycomb");
    else
      checked.both_given(path + "." + kinds[1], path + "." + kinds[0]);
    check_name(checked, path + ".material", specimen.shapes[i].material, {"void"});
  }
}

void check_windows(const Checked& checked, const std::vector<Window>& windows)
{
  for (std::size_t i = 0; i < windows.size(); ++i) {
    const std::string path = fmt::format("specimen.windows[{}]", i);
    if (!checked.sound(path)) continue;
    if (windows[i].x[0] >= windows[i].x[1])
      checked.refuse(path + ".x", "the first must be below the second");
    if (windows[i].y[0] >= windows[i].y[1])
      checked.refuse(path + ".y", "the first must be below the second");
    for (std::size_t j = 0; j < i; ++j) {
      if (windows[i].name == windows[j].name)
        checked.refuse(path + ".name", fmt::format("windows[{}] has this name already", j),
                       "Choose another name");
    }
  }
}

}  // namespace

void check_specimen(const Checked& checked)
{
  const Node* given = find(checked.root, "specimen");
  if (given == nullptr || given->kind == Node::Kind::scalar || given->kind == Node::Kind::list)
    return;
  const Specimen& specimen = checked.scene.specimen;
  if (!specimen.micrograph && !checked.sound("specimen.micrograph")) return;
  if (specimen.micrograph)
    check_micrograph(checked, *specimen.micrograph);
  else
    check_shapes(checked);
  check_windows(checked, specimen.windows);
}

}  // namespace mpm::scene
