#include <mpm/core/error.hpp>
#include <mpm/scene/reader.hpp>

#include <algorithm>
#include <ostream>

#include "checks.hpp"
#include <fmt/format.h>

namespace mpm::scene {

namespace {

/// For scenes without a material: the cell wall of J. A. Nairn (2006), "Numerical simulations of
/// transverse compression and densification in wood".
Material cell_wall()
{
  return {.values = {{"density", 1500.0},
                     {"youngs_modulus", 10.6e9},
                     {"poisson_ratio", 0.33},
                     {"yield_stress", 500e6}}};
}

void apply(Node& root, const std::vector<std::string>& overrides)
{
  std::vector<std::string> problems;
  for (const std::string& assignment : overrides) {
    try {
      apply_override(root, assignment);
    } catch (const InputError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    }
  }
  if (!problems.empty()) throw InputError(problems);
}

/// `count` values from 0 to `end`, in decimals somebody could have written; one is the end alone.
std::vector<double> evenly(double end, int count)
{
  std::vector<double> values;
  for (int i = count == 1 ? 1 : 0; i < std::max(count, 2) && count > 0; ++i) {
    const int last = std::max(count - 1, 1);
    const double value = end * i / last;
    values.push_back(i == last ? end : std::stod(fmt::format("{:.12g}", value)));
  }
  return values;
}

/// Snapshots hold particles in an order that changes when they go from rank to rank: who asks what
/// is done in each window needs to know them again.
std::vector<Field> filled_fields(std::vector<Field> fields, const std::vector<Window>& windows)
{
  const auto names = [&](Field field) { return std::ranges::find(fields, field) != fields.end(); };
  if (!windows.empty() && names(Field::plastic_work) && !names(Field::id))
    fields.push_back(Field::id);
  return fields;
}

Output filled_output(const OutputKeys& keys, const Scene& scene)
{
  constexpr int snapshots = 7;
  Output output = keys;
  output.fields = filled_fields(keys.fields, scene.specimen.windows);
  const int count = keys.snapshots.count.value_or(snapshots);
  if (keys.snapshots.strains || keys.snapshots.times) {
    output.snapshot_strains = keys.snapshots.strains.value_or(std::vector<double>{});
    output.snapshot_times = keys.snapshots.times.value_or(std::vector<double>{});
    std::ranges::sort(output.snapshot_strains);
    std::ranges::sort(output.snapshot_times);
  } else if (const auto* loading = std::get_if<Loading>(&scene.motion)) {
    output.snapshot_strains = evenly(loading->strain, count);
  } else {
    output.snapshot_times = evenly(std::get<FreeMotion>(scene.motion).end_time, count);
  }
  return output;
}

/// Known before any key is read: it decides how long lists have to be.
int dimensions_of(const Node& root)
{
  const Node* size = find(root, "specimen.size");
  const bool in_space = size != nullptr && size->items.size() == 3;
  return in_space || find(root, "specimen.depth") != nullptr ? 3 : 2;
}

/// Known before the formulas that use them; what is wrong with them is said where they are read.
Definitions definitions_of(const Node& root, int dimensions)
{
  Definitions definitions;
  if (const Node* node = find(root, "definitions")) {
    Problems said_elsewhere;
    Value<Definitions>::read({*node, "", said_elsewhere, {}}, {.dimensions = dimensions},
                             definitions);
  }
  return definitions;
}

/// Known before any key is read, as conditions look at it. Wood under a piston takes the step that
/// comes to an answer in least time (docs/formulations.md), unless a key of the other one is given.
FormulationKind default_formulation(const Node& root)
{
  Numerics of_cells, of_grid;
  of_cells.formulation = FormulationKind::total_lagrangian;
  of_grid.formulation = FormulationKind::updated_lagrangian;
  const bool needs_grid =
      std::ranges::any_of(parameters<Numerics>(), [&](const Parameter<Numerics>& row) {
        return !row.applies(of_cells, 2) && row.applies(of_grid, 2) &&
               find(root, joined("numerics", row.key)) != nullptr;
      });
  const bool crushes_wood =
      find(root, "specimen.micrograph") != nullptr && find(root, "loading") != nullptr;
  return (crushes_wood && !needs_grid ? of_cells : of_grid).formulation;
}

}  // namespace

Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides)
{
  to_si("1 m", Quantity::length);  // a missing table of units is no fault of the scene
  Node root = read_document(file);
  apply(root, overrides);

  SceneKeys keys;
  keys.dimensions = dimensions_of(root);
  keys.numerics.formulation = default_formulation(root);
  Problems problems;
  const Definitions definitions = definitions_of(root, keys.dimensions);
  read_map(Given{root, "", problems, definitions}, keys, keys.dimensions);
  if (auto& micrograph = keys.specimen.micrograph) {
    const auto folder = std::filesystem::absolute(file).parent_path();
    micrograph->file = (folder / micrograph->file).lexically_normal();
  }
  const Checked checked{keys, root, problems};
  check_materials(checked);
  check_specimen(checked);
  check_sides(checked);
  check_loads(checked);
  check_contact(checked);
  check_run(checked);
  problems.throw_if_any();

  Scene scene = keys;
  scene.file = file;
  if (scene.name.empty()) scene.name = file.stem().string();
  if (scene.materials.empty()) scene.materials = {cell_wall()};
  for (Material& material : scene.materials) fill_defaults(*material.law, material.values);
  for (Load& load : scene.loads) fill_defaults(*load.kind, load.values);
  for (Shape& shape : scene.specimen.shapes)
    if (shape.material.empty()) shape.material = scene.materials.front().name;
  scene.output = filled_output(keys.output_keys, scene);
  return scene;
}

void write_effective_scene(std::ostream& out, const Scene& scene)
{
  out << "# " << scene.file.filename().string() << " as it was run, every default filled in.\n";
  print_document(out, write_map(keys_of(scene), scene.dimensions));
}

}  // namespace mpm::scene
