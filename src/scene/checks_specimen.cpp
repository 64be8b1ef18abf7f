#include <mpm/core/nearest_name.hpp>
#include <mpm/scene/slices.hpp>

#include "checks.hpp"
#include <fmt/format.h>

namespace mpm::scene {

namespace {

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

void check_file(const Checked& checked, const std::filesystem::path& file)
{
  if (names_slices(file)) return;  // looked for where they are read
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored))
    checked.refuse("specimen.micrograph", "no such file: " + file.string(),
                   "Give the path from the scene's folder");
  else if (!std::filesystem::is_regular_file(file, ignored))
    checked.refuse("specimen.micrograph", file.string() + " is not a file",
                   "Name a BMP, PNG or TIFF picture, or how to draw one: *.anatomy.yaml");
}

void check_micrograph(const Checked& checked, const Micrograph& micrograph)
{
  check_file(checked, micrograph.file);
  if (micrograph.crop) {
    for (const int i : {2, 3}) {
      if ((*micrograph.crop)[static_cast<std::size_t>(i)] < 1)
        checked.refuse(fmt::format("specimen.crop[{}]", i),
                       fmt::format("the {} must be at least 1 pixel", i == 2 ? "width" : "height"));
    }
  }
  check_bands(checked, micrograph.bands);
}

/// What is impossible about a shape on its own; nothing is said about a key reported already.
void check_geometry(const Checked& checked, const std::string& path, const Geometry& geometry)
{
  std::visit(
      [&]<class Kind>(const Kind& kind) {
        const std::string map = path + "." + std::string(Kind::keyword);
        if (!checked.sound(map)) return;
        if (const auto defect = kind.defect(checked.scene.dimensions))
          checked.refuse(map + "." + defect->key, defect->reason);
      },
      geometry);
}

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
    checked.miss("specimen.size", "shapes lie in a rectangle of this size, or in a cuboid",
                 "Add e.g. size: [1 mm, 1 mm]");
  if (checked.given("specimen.shapes") && specimen.shapes.empty())
    checked.refuse("specimen.shapes", "a specimen needs at least one");

  const std::vector<std::string> keywords = shape_keywords(checked.scene.dimensions);
  for (std::size_t i = 0; i < specimen.shapes.size(); ++i) {
    const std::string path = fmt::format("specimen.shapes[{}]", i);
    std::vector<std::string> kinds;
    for (const std::string& kind : keywords)
      if (checked.given(path + "." + kind)) kinds.push_back(kind);
    if (kinds.size() == 1)
      check_geometry(checked, path, specimen.shapes[i].geometry);
    else if (kinds.empty() && checked.sound(path))
      checked.miss(path + "." + keywords.front(), "what the shape is",
                   "Add " + alternatives(keywords));
    else if (!kinds.empty())
      checked.both_given(path + "." + kinds[1], path + "." + kinds[0]);
    check_name(checked, path + ".material", specimen.shapes[i].material, {"void"});
    if (std::ranges::any_of(specimen.shapes[i].velocity, [](double c) { return c != 0; }))
      checked.both_given(path + ".velocity", "specimen.initial_velocity");
  }
}

void check_windows(const Checked& checked, const std::vector<Window>& windows)
{
  for (std::size_t i = 0; i < windows.size(); ++i) {
    const std::string path = fmt::format("specimen.windows[{}]", i);
    if (!checked.sound(path)) continue;
    const std::array ranges{windows[i].x, windows[i].y, windows[i].z};
    for (std::size_t d = 0; d < ranges.size(); ++d)
      if (ranges[d][0] >= ranges[d][1])
        checked.refuse(fmt::format("{}.{}", path, "xyz"[d]), "the first must be below the second");
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
