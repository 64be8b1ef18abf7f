#include <mpm/scene/schema.hpp>

namespace mpm::scene {

namespace {

template <class Motion>
Parameter<SceneKeys> motion(std::string key, std::string help, std::string excludes = "")
{
  return property<std::optional<Motion>, SceneKeys>(
      std::move(key),
      [](const SceneKeys& s) {
        const Motion* held = std::get_if<Motion>(&s.motion);
        return held != nullptr ? std::optional(*held) : std::nullopt;
      },
      [](SceneKeys& s, std::optional<Motion> value) { s.motion = *value; },
      {.default_text = "none", .excludes = std::move(excludes)}, std::move(help));
}

}  // namespace

template <>
const std::vector<Parameter<SceneKeys>>& parameters<SceneKeys>()
{
  using S = SceneKeys;
  using Materials = std::vector<Material>;
  static const std::vector<Parameter<S>> rows{
      member<S>("title", &S::title, {}, "one line about the scene"),
      member<S>("name", &S::name, {.default_text = "name of the scene file"},
                "of the results folder and its files"),
      property<std::optional<Material>, S>(
          "material",
          [](const S& s) {
            return s.materials.size() == 1 ? std::optional(s.materials[0]) : std::nullopt;
          },
          [](S& s, auto only) { s.materials = {*only}; },
          {.default_text = "cell wall: von_mises, 10.6 GPa, 0.33, 1500 kg/m^3, 500 MPa"},
          "the only material"),
      property<std::optional<Materials>, S>(
          "materials",
          [](const S& s) {
            return s.materials.size() > 1 ? std::optional(s.materials) : std::nullopt;
          },
          [](S& s, auto list) { s.materials = std::move(*list); },
          {.default_text = "none", .excludes = "material"}, "several materials, each with a name"),
      member<S>("specimen", &S::specimen, {.need = Need::required}, "what is crushed"),
      member<S>("grid", &S::grid, {.default_text = "see there"}, "background grid"),
      member<S>("numerics", &S::numerics, {.default_text = "see there"}, "the method"),
      motion<Loading>("loading", "compression by a piston; this or free_motion is needed"),
      motion<FreeMotion>("free_motion",
                         "motion from initial velocities, loads and moving sides, without a piston",
                         "loading"),
      member<S>("definitions", &S::definitions, {.default_text = "none"},
                "names that formulas may use, each also in the ones below it"),
      member<S>("loads", &S::loads, {.default_text = "none"}, "forces from outside"),
      member<S>("contact", &S::contacts, {.default_text = "none: bodies stick where they meet"},
                "between bodies that are not one, each in a velocity field of its own"),
      member<S>("exact_solution", &S::exact_solution, {.default_text = "none"},
                "what the run is compared with; its errors are in summary.json and "
                "exact_solution.csv"),
      member<S>("steps", &S::steps, {.bound = at_least(1), .default_text = "until the end"},
                "end after this many time steps"),
      member<S>("output", &S::output_keys, {.default_text = "see there"}, "what is written"),
  };
  return rows;
}

SceneKeys keys_of(const Scene& scene)
{
  SceneKeys keys{scene, {scene.output, {}}};
  const Output& output = scene.output;
  if (!output.snapshot_strains.empty())
    keys.output_keys.snapshots.strains = output.snapshot_strains;
  if (!output.snapshot_times.empty()) keys.output_keys.snapshots.times = output.snapshot_times;
  if (output.snapshot_strains.empty() && output.snapshot_times.empty())
    keys.output_keys.snapshots.count = 0;
  return keys;
}

}  // namespace mpm::scene
