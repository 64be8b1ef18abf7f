#pragma once
/// The block that kernels and whole steps are timed on: full cells, compressed evenly, elastic or
/// flowing plastically everywhere.

#include <mpm/materials/hencky.hpp>
#include <mpm/transfer/transfer.hpp>

#include <algorithm>
#include <numeric>
#include <string>
#include <tuple>

namespace mpm::performance {

struct Case {
  OneOf<ShapeRow> shape;
  OneOf<SchemeRow> scheme;
  bool plastic;
  friend auto operator<=>(const Case&, const Case&) = default;
};

/// shape/scheme/material, as in the table.
inline std::string name_of(const Case& c)
{
  return std::string(c.shape->keyword) + '/' + std::string(c.scheme->keyword) +
         (c.plastic ? "/plastic" : "/elastic");
}

template <class Visit>
void for_each_case(Visit visit)
{
  for (const OneOf<ShapeRow> shape : all_of_list<ShapeRow>())
    for (const OneOf<SchemeRow> scheme : all_of_list<SchemeRow>())
      for (const bool plastic : {false, true}) visit(Case{shape, scheme, plastic});
}

inline constexpr double spacing = 5e-6;  ///< m
inline constexpr double density = 1500;  ///< kg/m^3
inline constexpr LocalIndex margin = 3;  ///< empty cells around the block
/// 160,000 particles in the plane, 512,000 in space.
template <int Dim>
inline constexpr LocalIndex cells_per_axis = Dim == 2 ? 200 : 40;

template <int Dim>
std::string dimension()
{
  return Dim == 2 ? "2d" : "3d";
}

/// Cell wall; with a yield stress so low that a strain of 1e-4 is past it.
template <int Dim>
std::unique_ptr<Law<Dim>> make_law(bool plastic)
{
  constexpr IsotropicConstants elastic{10.6e9, 0.33};
  const auto yield = plastic ? std::optional(YieldConstants{1e6, 0}) : std::nullopt;
  if constexpr (Dim == 2)
    return make_hencky(PlaneAssumption::strain, elastic, density, yield);
  else
    return make_hencky_solid(elastic, density, yield);
}

template <int Dim>
GridGeometry<Dim> geometry(LocalIndex cells)
{
  return {Vec<Dim>::Constant(-margin * spacing), Vec<Dim>::Constant(spacing),
          IndexVec<Dim>::Constant(cells + 2 * margin + 1)};
}

/// Two particles per cell and axis; velocity along x `rate` (1/s) times the position, towards the
/// origin: a strain with a deviator, also in space.
template <int Dim>
Body<Dim> make_body(const Transfer<Dim>& transfer, bool musl, bool plastic, LocalIndex cells,
                    double rate)
{
  auto law = make_law<Dim>(plastic);
  auto state = law->state_columns();
  ParticleStore particles(
      transfer.motion_columns(musl), std::move(state),
      {"velocity", "mass", "affine_velocity", "grid_velocity", "initial_volume", "plastic_work"});
  Body<Dim> body{"block", 0, density, std::move(law), std::move(particles)};
  const LocalIndex across = 2 * cells;
  LocalIndex count = 1;
  double volume = 1;
  for (int d = 0; d < Dim; ++d) {
    count *= across;
    volume *= 0.5 * spacing;
  }
  for (LocalIndex k = 0; k < count; ++k) {
    const LocalIndex p = body.particles.add(k);
    ColumnGroup& motion = body.particles.motion();
    for (LocalIndex d = 0, rest = k; d < Dim; ++d, rest /= across) {
      // Not at the places where a stencil changes its first node.
      motion(d, p) = (0.27 + 0.5 * (rest % across)) * spacing;
      motion(Dim + d, p) = d == 0 ? -rate * motion(d, p) : 0;
    }
    motion(2 * Dim, p) = density * volume;
    set_domain_at_rest<Dim>(motion, p, Vec<Dim>::Constant(0.25 * spacing));
    body.particles.state()(0, p) = volume;
    body.law->initialise(body.particles.state(), p);
  }
  body.particles.seal();
  return body;
}

/// Order of the particles by the first node of their stencils (counting sort).
inline void order_by_node(const std::vector<LocalIndex>& nodes, LocalIndex grid_size,
                          std::vector<LocalIndex>& counts, std::vector<LocalIndex>& order)
{
  counts.assign(std::size_t(grid_size) + 1, 0);
  for (const LocalIndex node : nodes) ++counts[node + 1];
  std::partial_sum(counts.begin(), counts.end(), counts.begin());
  order.resize(nodes.size());
  for (std::size_t p = 0; p < nodes.size(); ++p) order[counts[nodes[p]]++] = LocalIndex(p);
}

}  // namespace mpm::performance
