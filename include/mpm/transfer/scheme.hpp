#pragma once
/// Transfer schemes: how particles learn from the grid, and what they tell it. Each is a type with
///   increments      whether particles take increments from the grid or its velocity,
///   affine          whether they have an affine velocity field,
///   shape_gradient  whether that field comes from gradients of the shape function,
///   row             what else the program knows of it.

#include <mpm/core/types.hpp>
#include <mpm/particles/particle_domain.hpp>
#include <mpm/shape/shape_row.hpp>

#include <string_view>
#include <vector>

namespace mpm {

/// Which momentum a reaction is measured from; it must fit the scheme, or the energy balance opens
/// by a quarter of the work.
struct ReactionBook {
  /// Of what particles receive: blends have something of both.
  double velocity_share;

  /// FLIP: particles receive (v after - v constrained before), so the projection of the particle
  /// velocities onto the wall is no impulse: R dt = m (v after constraint - v before constraint),
  /// both with the constrained velocity at the start of the step.
  static const ReactionBook increments;
  /// PIC, APIC, TPIC: particles receive the velocity itself: R dt = m v after - (mv + f dt).
  static const ReactionBook velocities;
  bool operator==(const ReactionBook&) const = default;
};
constexpr ReactionBook ReactionBook::increments{0};
constexpr ReactionBook ReactionBook::velocities{1};

struct SchemeRow {
  std::string_view keyword;
  std::string_view help;
  std::string_view words;  ///< in the plan of a run
  ReactionBook book;
  bool affine;  ///< whether particles have an affine velocity field
  std::optional<double> StableCfl::*stable_cfl;
  /// Whether the grid's velocity is refined before particles take it (NodeFields::refine), and
  /// whether only the part that it had before the forces.
  bool refines = false;
  bool refines_before_forces = false;
};

/// The kernels know of a scheme no more than this, and are compiled once for those that agree in
/// it. `blends`: with a share of the grid's velocity in what takes increments.
template <bool Increments, bool Affine, bool ShapeGradient, bool Blends>
struct SchemeKernels {
  static constexpr bool increments = Increments, affine = Affine, shape_gradient = ShapeGradient,
                        blends = Blends;
};
template <class Scheme, bool Blends = false>
using Kernels = SchemeKernels<Scheme::increments, Scheme::affine, Scheme::shape_gradient, Blends>;

/// The motion columns that every particle has, first of all.
template <int Dim>
struct LeadingColumns {
  static constexpr int position = 0;
  static constexpr int velocity = Dim;
  static constexpr int mass = 2 * Dim;
};

/// Where the motion columns of a particle lie. `grid_velocity` is there only for MUSL, whose
/// particles move in another pass than the one that reads the grid; the affine field only for
/// the schemes that have one; the domain (component d of half axis k at d + Dim * k) only with a
/// shape function that has one.
template <int Dim, class Scheme, bool HasDomain = false>
struct MotionColumns : LeadingColumns<Dim> {
  static constexpr int affine = 2 * Dim + 1;
  static constexpr int domain = affine + (Scheme::affine ? Dim * Dim : 0);
  static constexpr int grid_velocity = domain + (HasDomain ? Dim * Dim : 0);

  static std::vector<Column> columns(bool musl)
  {
    std::vector<Column> list{{"position", Dim, "m"}, {"velocity", Dim, "m/s"}, {"mass", 1, "kg"}};
    if (Scheme::affine) list.push_back({"affine_velocity", Dim * Dim, "1/s"});
    if (HasDomain) list.push_back({std::string(domain_column), Dim * Dim, "m"});
    if (musl) list.push_back({"grid_velocity", Dim, "m/s"});
    return list;
  }
};

}  // namespace mpm
