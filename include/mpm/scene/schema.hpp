#pragma once
/// Which struct is a map of the scene file. The rows are in src/scene/schema_*.cpp: a new key is
/// one row there.

#include <mpm/scene/parameter.hpp>
#include <mpm/scene/scene.hpp>

#include <optional>
#include <vector>

namespace mpm::scene {

/// `snapshots` as written: what it means depends on the motion.
struct SnapshotKeys {
  std::optional<std::vector<double>> strains, times;
  std::optional<int> count;
};

struct OutputKeys : Output {
  SnapshotKeys snapshots;
};

/// The whole file: the scene, with the members whose keys do not map one to one.
struct SceneKeys : Scene {
  OutputKeys output_keys;
};

template <>
inline constexpr std::string_view section<SceneKeys> = "scene";
template <>
inline constexpr std::string_view section<Material> = "material";
template <>
inline constexpr std::string_view section<Failure> = "failure";
template <>
inline constexpr std::string_view section<Specimen> = "specimen";
template <>
inline constexpr std::string_view section<GrayBand> = "gray band";
template <>
inline constexpr std::string_view section<Window> = "window";
template <>
inline constexpr std::string_view section<Shape> = "shape";
template <>
inline constexpr std::string_view section<Grid> = "grid";
template <>
inline constexpr std::string_view section<Numerics> = "numerics";
template <>
inline constexpr std::string_view section<Loading> = "loading";
template <>
inline constexpr std::string_view section<LoadCell> = "load cell";
template <>
inline constexpr std::string_view section<FreeMotion> = "free motion";
template <>
inline constexpr std::string_view section<MovingSide> = "moving side";
template <>
inline constexpr std::string_view section<Load> = "load";
template <>
inline constexpr std::string_view section<BodyContact> = "contact";
template <>
inline constexpr std::string_view section<ExactSolution> = "exact solution";
template <>
inline constexpr std::string_view section<OutputKeys> = "output";
template <>
inline constexpr std::string_view section<Checkpoints> = "checkpoints";
inline constexpr std::string_view snapshots_section = "snapshots";

template <>
const std::vector<Parameter<SceneKeys>>& parameters<SceneKeys>();
template <>
const std::vector<Parameter<Material>>& parameters<Material>();
template <>
const std::vector<Parameter<Failure>>& parameters<Failure>();
template <>
const std::vector<Parameter<Specimen>>& parameters<Specimen>();
template <>
const std::vector<Parameter<GrayBand>>& parameters<GrayBand>();
template <>
const std::vector<Parameter<Window>>& parameters<Window>();
template <>
const std::vector<Parameter<Shape>>& parameters<Shape>();
template <>
const std::vector<Parameter<Grid>>& parameters<Grid>();
template <>
const std::vector<Parameter<Numerics>>& parameters<Numerics>();
template <>
const std::vector<Parameter<Loading>>& parameters<Loading>();
template <>
const std::vector<Parameter<LoadCell>>& parameters<LoadCell>();
template <>
const std::vector<Parameter<FreeMotion>>& parameters<FreeMotion>();
template <>
const std::vector<Parameter<MovingSide>>& parameters<MovingSide>();
template <>
const std::vector<Parameter<Load>>& parameters<Load>();
template <>
const std::vector<Parameter<BodyContact>>& parameters<BodyContact>();
template <>
const std::vector<Parameter<ExactSolution>>& parameters<ExactSolution>();
template <>
const std::vector<Parameter<OutputKeys>>& parameters<OutputKeys>();
template <>
const std::vector<Parameter<Checkpoints>>& parameters<Checkpoints>();
template <>
const std::vector<Parameter<SnapshotKeys>>& parameters<SnapshotKeys>();

/// A number stands for `count`.
template <>
struct Value<SnapshotKeys> {
  static bool read(const Given& given, const Rule& rule, SnapshotKeys& keys);
  static Node write(const SnapshotKeys& keys, const Rule& rule);
  static std::string describe(const Rule& rule);
  static Json schema(const Rule& rule);
};

/// The keys of a finished scene.
SceneKeys keys_of(const Scene& scene);

}  // namespace mpm::scene
