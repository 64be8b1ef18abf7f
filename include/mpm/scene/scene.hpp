#pragma once
/// What a scene file says, in SI units, with every default filled in. Plain data: reading and
/// checking live in reader.hpp.

#include <mpm/conditions/load_rows.hpp>
#include <mpm/conditions/side_rows.hpp>
#include <mpm/conditions/wall_motion.hpp>
#include <mpm/core/side.hpp>
#include <mpm/materials/laws.hpp>
#include <mpm/scene/plane_or_space.hpp>
#include <mpm/scene/shapes.hpp>
#include <mpm/transfer/schemes.hpp>

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace mpm::scene {

using Plane = PlaneAssumption;

// ---------------------------------------------------------------------------- materials

/// Where a cell of total_lagrangian fails and is removed.
struct Failure {
  std::optional<double> plastic_strain;  ///< equivalent, of laws that have one
  std::optional<double> stretch;         ///< largest principal one
  bool operator==(const Failure&) const = default;
};

/// The other keys are the law's own (materials/laws.hpp).
struct Material {
  std::string name = "cell_wall";
  OneOf<LawRow> law = "von_mises";
  ParameterValues values{};
  std::optional<Failure> failure{};
  /// kg/m^3; 0 for a law without one.
  double density() const { return values.has("density") ? values.number("density") : 0; }
  bool operator==(const Material&) const = default;
};

// ---------------------------------------------------------------------------- specimen

enum class Wall { bright, dark };
enum class ThresholdRule { value, otsu, target_relative_density, target_density };
enum class Sampling {
  match,     ///< as many locations as pixels, by share, reach the threshold
  threshold  ///< a location's mean gray is compared with the pixels' threshold
};

/// Gray levels [from, to] (inclusive lower, exclusive upper, of 0..256) made of one material.
struct GrayBand {
  double from = 0;
  double to = 256;
  std::string material;
  bool operator==(const GrayBand&) const = default;
};

/// Part of the specimen whose relative density is reported, as fractions of its size.
struct Window {
  std::string name;
  std::array<double, 2> x{0, 1};
  std::array<double, 2> y{0, 1};
  std::array<double, 2> z{0, 1};  ///< in space
  bool operator==(const Window&) const = default;
};

struct Micrograph {
  std::filesystem::path file;  ///< resolved against the scene's folder
  /// Of a drawn picture, in the place of its file's: another piece of the same kind of wood.
  std::optional<int> seed;
  std::optional<std::array<double, 2>> image_size;  ///< m, of the whole image as stored
  std::optional<std::array<double, 2>> pixel_size;  ///< m
  std::optional<double> depth;  ///< m along z, through which the picture is drawn out in space
  std::optional<std::array<int, 4>> crop;  ///< pixels of the file: x, y (from top), width, height
  int rotate = 0;                          ///< degrees counter-clockwise: 0, 90, 180, 270
  bool flip_horizontal = false;            ///< after the rotation
  bool flip_vertical = false;
  Wall wall = Wall::bright;
  ThresholdRule threshold_rule = ThresholdRule::value;
  double threshold = 150;              ///< gray level of 0..255
  double target_relative_density = 0;  ///< with ThresholdRule::target_relative_density
  double target_density = 0;           ///< kg/m^3, with ThresholdRule::target_density
  double threshold_shift = 0;          ///< gray levels added to what any of the rules gives
  Sampling sampling = Sampling::match;
  int remove_specks = 0;            ///< wall pieces of fewer locations than this are void
  bool remove_unconnected = false;  ///< keep only pieces linked to the largest
  std::vector<GrayBand> bands;      ///< several materials by gray; empty: one material
  /// The file says how to draw the picture (docs/anatomy.md).
  bool is_drawn() const { return file.string().ends_with(".anatomy.yaml"); }
  bool operator==(const Micrograph&) const = default;
};

/// Either an image or shapes; shapes need `size`.
struct Specimen {
  std::optional<Micrograph> micrograph;
  std::vector<Shape> shapes;
  PerAxis<double> size{};  ///< m; from the image if there is one
  /// m/s, of all that can be deformed, by the place at t = 0; without them the shapes' own.
  std::optional<PerAxis<Formula>> initial_velocity;
  std::vector<Window> windows;
  bool operator==(const Specimen&) const = default;
};

// ---------------------------------------------------------------------------- numerics

struct Grid {
  std::optional<PerAxis<int>> cells;       ///< over the specimen
  std::optional<PerAxis<double>> spacing;  ///< m; rounded so that whole cells fit
  int particles_per_cell = 2;              ///< per direction
  PerSide<double> margin{};                ///< m, empty space beside the specimen
  bool operator==(const Grid&) const = default;
};

/// What follows a numerical failure.
enum class Recovery {
  stop,
  retry  ///< from the last sound state with half the step
};

enum class DecompositionKind { automatic, cuts, metis };

enum class FormulationKind { updated_lagrangian, total_lagrangian };

/// Of the cells of total_lagrangian.
enum class Surface {
  stairs,  ///< of locations
  fitted   ///< where the wall ends in the picture, or the shape
};

struct Numerics {
  FormulationKind formulation = FormulationKind::updated_lagrangian;  ///< or by what is crushed
  Surface surface = Surface::stairs;
  /// Over the modulus of the fastest wave times the depth over the size of a location, of the
  /// pressure of a wall that pushes, and of half of that across a flush face in total_lagrangian,
  /// where 0 is none.
  std::optional<double> contact_stiffness;
  /// Of total_lagrangian: least stretch of cells that keep their mass. Default depends on what
  /// moves the specimen.
  std::optional<double> mass_scaling;
  Plane plane = Plane::strain;  ///< of a scene in the plane
  double thickness = 1;         ///< m, out of the plane
  OneOf<ShapeRow> shape_function = "gimp";
  OneOf<SchemeRow> scheme = "flip";
  double domain = 1;         ///< of GIMP, over the size of a particle
  double pic_share = 0;      ///< of the grid's velocity in that of FLIP
  int refinement_order = 4;  ///< of a scheme that refines the grid's velocity
  OneOf<UpdateOrderRow> update_order = "musl";
  bool f_bar = false;         ///< the stress sees means of the divergence
  std::optional<double> cfl;  ///< default depends on shape function and update order
  DecompositionKind decomposition = DecompositionKind::automatic;
  PerAxis<int> ranks{};          ///< process grid of cuts; 0: chosen
  int repartition_interval = 0;  ///< steps; 0: when it pays
  Recovery recovery = Recovery::stop;
  bool operator==(const Numerics&) const = default;
};

// ---------------------------------------------------------------------------- loading

/// Both sides of an axis are periodic or none.
using Lateral = OneOf<SideRow>;
enum class Grip { stick, slip, contact };

struct LoadCell {
  int cells = 3;                ///< thickness in grid cells
  double stiffness_ratio = 10;  ///< modulus and density relative to the first material
  bool operator==(const LoadCell&) const = default;
};

struct Loading {
  Side piston = Side::right;
  double speed = 0;     ///< m/s
  double strain = 0.6;  ///< end of the run
  /// s, smooth start (0: at once). Default: eight times what the fastest wave needs to cross.
  std::optional<double> ramp_time;
  Grip grip = Grip::stick;            ///< of piston and fixed edge
  double friction = 0;                ///< on them, tangential over normal force, at most
  PerLateralSide<Lateral> lateral{};  ///< rigid unless given
  std::optional<LoadCell> load_cell;
  bool operator==(const Loading&) const = default;
};

/// A table of velocities along the side's axis.
using MotionTable = std::vector<WallMotion::Entry>;

/// A rigid wall at a side that follows a table.
struct MovingSide {
  Side side = Side::left;
  Grip grip = Grip::stick;
  double friction = 0;  ///< on it, tangential over normal force, at most
  MotionTable table;
  bool operator==(const MovingSide&) const = default;
};

/// Free motion without a piston: runs to `end_time`.
struct FreeMotion {
  double end_time = 0;                                                     ///< s
  PerSide<Lateral> sides{"free", "free", "free", "free", "free", "free"};  ///< of the grid
  std::vector<MovingSide> moving_sides;
  bool operator==(const FreeMotion&) const = default;
};

/// The keys beside `kind` are the load's own (conditions/load_rows.hpp).
struct Load {
  OneOf<LoadRow> kind;
  ParameterValues values{};
  bool operator==(const Load&) const = default;
};

/// Between two bodies, each in a velocity field of its own.
struct BodyContact {
  std::vector<std::string> between;  ///< two materials
  double friction = 0;               ///< tangential over normal force, at most
  bool operator==(const BodyContact&) const = default;
};

// ---------------------------------------------------------------------------- output

enum class Field {
  velocity,
  stress,
  von_mises,
  pressure,
  volume_ratio,
  plastic_strain,
  plastic_work,
  material,
  id,
  rank
};

/// What the run is compared with, line by line of the history. All formulas may use the place at
/// t = 0 (X, Y, Z), which is what they are usually written in.
struct ExactSolution {
  std::optional<PerAxis<Formula>> displacement;  ///< m
  std::optional<PerAxis<Formula>> velocity;      ///< m/s
  /// Cauchy stress, Pa, by component.
  std::optional<Formula> stress_xx, stress_yy, stress_zz, stress_xy, stress_yz, stress_xz;
  bool operator==(const ExactSolution&) const = default;
};

/// When a run leaves its state behind, to go on from.
struct Checkpoints {
  std::optional<int> steps;         ///< every so many
  std::optional<double> strain;     ///< with every so much more
  std::optional<double> wall_time;  ///< s, every so long
  int keep = 2;                     ///< the last so many
  bool operator==(const Checkpoints&) const = default;
};

struct Output {
  int history_lines = 600;
  std::vector<double> snapshot_strains;                              ///< with a piston
  std::vector<double> snapshot_times;                                ///< s
  std::vector<Field> fields{Field::von_mises, Field::plastic_work};  ///< position is always there
  bool compress = false;  ///< gzip 1 + shuffle: half the size, 3-4 times the time
  std::optional<Checkpoints> checkpoints;
  bool operator==(const Output&) const = default;
};

struct Scene {
  std::filesystem::path file;  ///< as given
  std::string name;            ///< stem of the file unless `name` is given
  std::string title;
  int dimensions = 2;  ///< 2: in the plane; 3: in space
  std::vector<Material> materials;
  Specimen specimen;
  Grid grid;
  Numerics numerics;
  std::variant<Loading, FreeMotion> motion;
  std::vector<Load> loads;
  /// Without any, all bodies move in one velocity field, or are one mesh.
  std::vector<BodyContact> contacts;
  Definitions definitions;
  std::optional<ExactSolution> exact_solution;
  std::optional<long> steps;  ///< end after this many steps (benchmarks)
  Output output;
  bool operator==(const Scene&) const = default;
};

/// Whether a wall pushes what comes to its face, and holds nothing.
bool walls_push(const Scene& scene);
/// That is given, or the default of the formulation.
double contact_stiffness(const Numerics& numerics);

}  // namespace mpm::scene
