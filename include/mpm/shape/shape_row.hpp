#pragma once
#include <optional>
#include <string_view>

namespace mpm {

/// Largest stable step in units of h / c, c the present wave speed (docs/theory.md); nothing where
/// no step is stable. Of a bar with a free end at the worst place: spectral radius 1 of the whole
/// step, two particles per cell.
struct StableCfl {
  std::optional<double> increments{};   ///< particles take increments from the grid: FLIP
  std::optional<double> velocities{};   ///< they take its velocity: PIC
  std::optional<double> affine{};       ///< and an affine field; what crushed wood bears
  std::optional<double> refined{};      ///< the velocity of a better mass matrix, up to FMPM(8)
  std::optional<double> stress_last{};  ///< gradient of the velocity that the force changed: USL
};

/// All that the program knows of a shape function; each has one, `row`.
struct ShapeRow {
  std::string_view keyword;
  std::string_view help;
  std::string_view words;  ///< in the plan of a run
  StableCfl stable_cfl;
  double cfl_share;  ///< of the stable one, by default
  /// Nanoseconds per particle and step on one core of a 2.6 GHz server processor of 2023 with
  /// 512-bit vectors, in the plane: the order of magnitude of a run time, from the shipped block
  /// scenes.
  double step_cost;
  bool has_domain = false;  ///< of a size that the scene may change (numerics.domain)
};

}  // namespace mpm
