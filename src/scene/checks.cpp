#include "checks.hpp"

#include <fmt/format.h>

namespace mpm::scene {

void Checked::refuse(const std::string& path, const std::string& reason,
                     const std::string& remedy) const
{
  const Node* node = find(root, path);
  if (node != nullptr && sound(path))
    Given{*node, path, problems, scene.definitions}.refuse(reason, remedy);
}

void Checked::miss(const std::string& path, const std::string& reason,
                   const std::string& remedy) const
{
  if (!sound(path)) return;
  problems.add(place_of(root, path), path,
               fmt::format("{} is missing ({}). {}.", path, reason, remedy));
}

void Checked::both_given(const std::string& path, const std::string& other) const
{
  if (!given(path) || !given(other)) return;
  problems.add(place_of(root, path), path,
               fmt::format("{} does not go with {} (given at {}). Keep one of them.", path, other,
                           place_of(root, other).text()));
}

std::string Checked::material_path(std::size_t index) const
{
  return given("material") ? "material" : fmt::format("materials[{}]", index);
}

std::vector<std::string> Checked::material_names() const
{
  std::vector<std::string> names;
  if (scene.materials.empty() && !given("material") && !given("materials"))
    names.push_back(Material{}.name);
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    if (!sound(material_path(i) + ".name")) return {};
    names.push_back(scene.materials[i].name);
  }
  return names;
}

/// Combinations of shape function, scheme and update order that have no stable step.
void check_stability(const Checked& checked)
{
  const Numerics& numerics = checked.scene.numerics;
  const ShapeRow& shape = *numerics.shape_function;
  const UpdateOrderRow& order = *numerics.update_order;
  if (!checked.sound("numerics.shape_function")) return;
  const std::string reason =
      fmt::format("with {} shape functions no time step is stable at free edges", shape.keyword);
  const auto refuse_order = [&](const std::string& why) {
    const auto bears = std::ranges::find_if(
        list_of<UpdateOrderRow>(), [](const UpdateOrderRow& other) { return !other.stable_cfl; });
    checked.refuse("numerics.update_order", why,
                   fmt::format("Use update_order: {}", bears->keyword));
  };
  if (order.stable_cfl && !(shape.stable_cfl.*order.stable_cfl))
    refuse_order(reason);
  else if (order.stable_cfl && numerics.scheme->refines)
    refuse_order(
        fmt::format("with {} the stable step falls with every refinement of the velocity "
                    "that the stress sees",
                    numerics.scheme->keyword));
  const auto family = numerics.scheme->stable_cfl;
  if (shape.stable_cfl.*family) return;
  std::vector<std::string> shapes;
  for (const ShapeRow& other : list_of<ShapeRow>())
    if (other.stable_cfl.*family) shapes.emplace_back(other.keyword);
  const auto bears = std::ranges::find_if(list_of<SchemeRow>(), [&](const SchemeRow& other) {
    return (shape.stable_cfl.*other.stable_cfl).has_value();
  });
  checked.refuse(
      "numerics.scheme", reason,
      fmt::format("Use scheme: {}, or shape_function: {}", bears->keyword, alternatives(shapes)));
}

namespace {

/// What would leave none.
void check_checkpoints(const Checked& checked)
{
  const std::string path = "output.checkpoints";
  const auto& checkpoints = checked.scene.output_keys.checkpoints;
  if (!checkpoints || !checked.given(path) || !checked.sound(path)) return;
  if (checkpoints->strain && std::holds_alternative<FreeMotion>(checked.scene.motion))
    checked.refuse(path + ".strain", "free motion has no strain", "Use steps or wall_time");
  if (!checkpoints->steps && !checkpoints->strain && !checkpoints->wall_time)
    checked.refuse(path, "it does not say when",
                   "Add wall_time: 30 min, strain: 5 % or steps: 10000");
}

}  // namespace

void check_run(const Checked& checked)
{
  const SceneKeys& scene = checked.scene;
  if (checked.given("name") && (scene.name.empty() || scene.name.front() == '.' ||
                                scene.name.find('/') != std::string::npos))
    checked.refuse("name", "it names a folder", "Use letters, digits, - and _");

  if (!checked.given("loading") && !checked.given("free_motion") && checked.sound("free_motion"))
    checked.miss("loading", "what moves the specimen",
                 "Add loading: {piston: right, speed: 10 m/s}, or free_motion: {end_time: 1 ms}");

  const Numerics& numerics = scene.numerics;
  check_stability(checked);
  if (numerics.f_bar && numerics.plane == Plane::stress)
    checked.refuse("numerics.f_bar", "in plane stress the thickness follows, and nothing locks",
                   "Leave it out");
  if (checked.sound("grid.particles_per_cell") && numerics.domain > scene.grid.particles_per_cell)
    checked.refuse("numerics.domain", "domains would be larger than a cell",
                   fmt::format("Set at most {}, as many as grid.particles_per_cell",
                               scene.grid.particles_per_cell));
  if (numerics.decomposition == DecompositionKind::metis && checked.given("numerics.ranks"))
    checked.refuse("numerics.ranks", "METIS makes no process grid", "Use decomposition: cuts");

  const std::string strains = "output.snapshots.strains";
  const std::string times = "output.snapshots.times";
  const SnapshotKeys& snapshots = scene.output_keys.snapshots;
  if (checked.given("output.snapshots.count") && (snapshots.strains || snapshots.times))
    checked.both_given("output.snapshots.count", snapshots.strains ? strains : times);
  if (const auto* loading = std::get_if<Loading>(&scene.motion)) {
    if (snapshots.strains && checked.sound("loading.strain")) {
      for (std::size_t i = 0; i < snapshots.strains->size(); ++i) {
        if ((*snapshots.strains)[i] > loading->strain)
          checked.refuse(fmt::format("{}[{}]", strains, i),
                         fmt::format("the run ends at loading.strain {}", loading->strain),
                         "Lower it or raise loading.strain");
      }
    }
  }
  check_checkpoints(checked);
  if (const auto* motion = std::get_if<FreeMotion>(&scene.motion)) {
    if (snapshots.strains) checked.refuse(strains, "free motion has no strain", "Use times");
    if (snapshots.times && checked.sound("free_motion")) {
      for (std::size_t i = 0; i < snapshots.times->size(); ++i) {
        if ((*snapshots.times)[i] > motion->end_time)
          checked.refuse(fmt::format("{}[{}]", times, i),
                         fmt::format("the run ends at free_motion.end_time {}",
                                     in_readable_unit(motion->end_time, Quantity::time)),
                         "Lower it or raise free_motion.end_time");
      }
    }
  }
  const std::vector<Field>& fields = scene.output_keys.fields;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (std::find(fields.begin(), fields.begin() + static_cast<long>(i), fields[i]) !=
        fields.begin() + static_cast<long>(i))
      checked.refuse(fmt::format("output.fields[{}]", i), "it is in the list already",
                     "Remove one");
  }
}

}  // namespace mpm::scene
