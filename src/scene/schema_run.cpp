#include <mpm/scene/schema.hpp>

namespace mpm::scene {

namespace {

constexpr Bound snapshot_count = from_to(0, 100000);

}  // namespace

template <>
const std::vector<Parameter<Grid>>& parameters<Grid>()
{
  using enum Quantity;
  using G = Grid;
  static const std::vector<Parameter<G>> rows{
      member<G>("cells", &G::cells,
                {.bound = at_least(2), .default_text = "150 along x, nearly square ones along y"},
                "cells over the specimen along each axis"),
      member<G>("spacing", &G::spacing,
                {.quantity = length,
                 .bound = above(0),
                 .spread = true,
                 .default_text = "from cells",
                 .excludes = "cells"},
                "cell size, rounded so that whole cells fit"),
      member<G>("particles_per_cell", &G::particles_per_cell, {.bound = from_to(1, 8)},
                "material points per cell and direction"),
      member<G>(
          "margin", &G::margin,
          {.quantity = length,
           .bound = at_least(0),
           .spread = true,
           .default_text = "0; 25 % of the width at free lateral sides"},
          "empty space left, right, below and above the specimen; in space also behind and before; "
          "cells of total_lagrangian go where they will"),
  };
  return rows;
}

template <>
const std::vector<Parameter<Numerics>>& parameters<Numerics>()
{
  using N = Numerics;
  const auto on_grid = [](const N& n) {
    return n.formulation == FormulationKind::updated_lagrangian;
  };
  const Condition<N> of_grid{on_grid, "formulation: updated_lagrangian"};
  const Condition<N> of_cells{
      [](const N& n) { return n.formulation == FormulationKind::total_lagrangian; },
      "formulation: total_lagrangian"};
  static const std::vector<Parameter<N>> rows{
      member<N>(
          "formulation", &N::formulation,
          {.default_text = "total_lagrangian where a piston crushes a micrograph and no key of the "
                           "other one is given; else updated_lagrangian"},
          "weights in the present configuration, on a grid that forgets: for what tears, "
          "mixes or flows; or in the reference one, on cells that are locations, with contact "
          "of the body with itself: for crushing"),
      member<N>("surface", &N::surface, {},
                "stairs of locations; or corners of cells at the surface stand where the wall ends "
                "in the picture or in the shapes")
          .when(of_cells)
          .in_plane(),
      member<N>("contact_stiffness", &N::contact_stiffness,
                {.bound = from_to(0, 100),
                 .default_text = "2 of total_lagrangian, 0.5 of walls with grip: contact"},
                "times the modulus of the fastest wave times the depth over the size of a location "
                "is the pressure of a wall with grip: contact (updated_lagrangian); twice that is "
                "the one across a flush contact of total_lagrangian, 0 there: no contact"),
      member<N>("mass_scaling", &N::mass_scaling,
                {.bound = from_to(0, 1), .default_text = "0.8 under a piston; 0 in free motion"},
                "cells with a smaller least stretch are made heavier, by the square of this over "
                "it, so that they do not shorten the step; 0: none")
          .when(of_cells),
      member<N>("plane", &N::plane, {}, "plane strain or plane stress").in_plane(),
      member<N>("thickness", &N::thickness, {.quantity = Quantity::length, .bound = above(0)},
                "out of the plane")
          .in_plane(),
      member<N>("shape_function", &N::shape_function, {}, "how particles and nodes share")
          .when(of_grid),
      member<N>("domain", &N::domain, {.bound = from_to(0.25, 8)},
                "size of GIMP's domains over that of a particle; at most a cell")
          .when({[on_grid](const N& n) { return on_grid(n) && n.shape_function->has_domain; },
                 "shape_function: gimp"}),
      member<N>("scheme", &N::scheme, {}, "what particles take from the grid").when(of_grid),
      member<N>("pic_share", &N::pic_share, {.bound = from_to(0, 1)},
                "of the grid's velocity in the particles', each step: a blend of FLIP and PIC")
          .when({[on_grid](const N& n) {
                   return on_grid(n) && n.scheme->book == ReactionBook::increments;
                 },
                 "scheme: flip"}),
      member<N>("refinement_order", &N::refinement_order, {.bound = from_to(2, 8)},
                "k of FMPM(k), m of XPIC(m): how far the mass matrix is inverted; each more is a "
                "pass")
          .when({[on_grid](const N& n) { return on_grid(n) && n.scheme->refines; },
                 "scheme: fmpm or xpic"}),
      member<N>(
          "update_order", &N::update_order, {},
          "stress from re-mapped velocities (musl; moves too: musl_displacement), before (usf) or "
          "after (usl) the forces, or one half of it before and one after (usavg)")
          .when(of_grid),
      member<N>("f_bar", &N::f_bar, {},
                "volumetric increments averaged around every node, against locking near Poisson's "
                "ratio 1/2; not in plane stress")
          .when(of_grid),
      member<N>(
          "cfl", &N::cfl,
          {.bound = {End{0, false}, End{3, true}},
           .default_text = "by shape function, scheme and update order; of total_lagrangian by "
                           "contact_stiffness"},
          "time step times fastest wave over the size of a cell, of total_lagrangian of a "
          "location"),
      member<N>("decomposition", &N::decomposition, {},
                "straight cuts, blocks of cells mapped by METIS, or what is better balanced"),
      member<N>("ranks", &N::ranks, {.bound = at_least(0), .default_text = "chosen"},
                "process grid of cuts along each axis; 0: chosen"),
      member<N>("repartition_interval", &N::repartition_interval, {.bound = at_least(0)},
                "move the borders between ranks every so many steps (for tests); 0: when it pays"),
      member<N>("recovery", &N::recovery, {},
                "after a numerical failure: end the run, or go back to the last sound state and on "
                "with half the step, four times at most"),
  };
  return rows;
}

template <>
const std::vector<Parameter<Loading>>& parameters<Loading>()
{
  using enum Quantity;
  using L = Loading;
  static const std::vector<Parameter<L>> rows{
      member<L>("piston", &L::piston, {},
                "side from which the piston comes; back and front in space"),
      member<L>("speed", &L::speed,
                {.quantity = velocity, .bound = above(0), .need = Need::required}, "of the piston"),
      member<L>("strain", &L::strain, {.quantity = fraction, .bound = between(0, 0.99)},
                "piston travel over specimen length at the end of the run"),
      member<L>("ramp_time", &L::ramp_time,
                {.quantity = time,
                 .bound = at_least(0),
                 .default_text = "8 times the fastest wave's way through"},
                "smooth rise of the piston's speed; 0: at once"),
      member<L>(
          "grip", &L::grip, {},
          "of the piston and of the fixed edge opposite; contact: they push, and hold nothing"),
      member<L>("friction", &L::friction, {.bound = at_least(0)},
                "on piston and fixed edge, largest tangential over normal force; with "
                "formulation: total_lagrangian")
          .when({[](const L& l) { return l.grip == Grip::contact; }, "grip: contact"}),
      member<L>(
          "lateral", &L::lateral, {.spread = true},
          "the sides along the travel: lower (or left), upper (or right); in space of the first, "
          "then of the second of the two other axes"),
      member<L>("load_cell", &L::load_cell, {.default_text = "none"},
                "elastic layer at the fixed edge that measures the force"),
  };
  return rows;
}

template <>
const std::vector<Parameter<LoadCell>>& parameters<LoadCell>()
{
  using C = LoadCell;
  static const std::vector<Parameter<C>> rows{
      member<C>("cells", &C::cells, {.bound = at_least(1)}, "thickness in grid cells"),
      member<C>("stiffness_ratio", &C::stiffness_ratio, {.bound = above(0)},
                "modulus and density relative to the first material"),
  };
  return rows;
}

template <>
const std::vector<Parameter<FreeMotion>>& parameters<FreeMotion>()
{
  using F = FreeMotion;
  static const std::vector<Parameter<F>> rows{
      member<F>("end_time", &F::end_time,
                {.quantity = Quantity::time, .bound = above(0), .need = Need::required},
                "end of the run"),
      member<F>("sides", &F::sides, {.spread = true},
                "of the grid: left, right, bottom, top; in space also back, front"),
      member<F>("moving_sides", &F::moving_sides, {.default_text = "none"},
                "rigid walls at sides that follow a table"),
  };
  return rows;
}

template <>
const std::vector<Parameter<MovingSide>>& parameters<MovingSide>()
{
  using M = MovingSide;
  static const std::vector<Parameter<M>> rows{
      member<M>("side", &M::side, {.need = Need::required}, "where the wall stands at the start"),
      member<M>("grip", &M::grip, {},
                "whether it holds what it touches, along its face too; contact: it pushes only"),
      member<M>("friction", &M::friction, {.bound = at_least(0)},
                "on it, largest tangential over normal force; with formulation: total_lagrangian")
          .when({[](const M& m) { return m.grip == Grip::contact; }, "grip: contact"}),
      member<M>("table", &M::table, {.quantity = Quantity::velocity, .need = Need::required},
                "times and velocities along the side's axis, straight lines between them, constant "
                "before and after"),
  };
  return rows;
}

template <>
const std::vector<Parameter<OutputKeys>>& parameters<OutputKeys>()
{
  using O = OutputKeys;
  static const std::vector<Parameter<O>> rows{
      member<O>("history_lines", &O::history_lines, {.bound = at_least(2)},
                "lines of the history over the whole run"),
      member<O>("snapshots", &O::snapshots, {.default_text = "7, evenly"},
                "when to write all particles"),
      member<O>("fields", &O::fields, {},
                "of each particle, beside its position; with `plastic_work` and windows of the "
                "specimen, `id` too"),
      member<O>("compress", &O::compress, {}, "half the size, three to four times the time"),
      member<O>("checkpoints", &O::checkpoints, {.default_text = "none"},
                "when to leave the state behind, for --restart"),
  };
  return rows;
}

template <>
const std::vector<Parameter<Checkpoints>>& parameters<Checkpoints>()
{
  using C = Checkpoints;
  static const std::vector<Parameter<C>> rows{
      member<C>("steps", &C::steps, {.bound = at_least(20), .default_text = "none"},
                "every so many steps, and no more often than every 20"),
      member<C>("strain", &C::strain,
                {.quantity = Quantity::fraction, .bound = above(0), .default_text = "none"},
                "with every so much more strain, under a piston"),
      member<C>("wall_time", &C::wall_time,
                {.quantity = Quantity::time, .bound = above(0), .default_text = "none"},
                "every so long by the clock"),
      member<C>("keep", &C::keep, {.bound = at_least(1)}, "the last so many"),
  };
  return rows;
}

template <>
const std::vector<Parameter<SnapshotKeys>>& parameters<SnapshotKeys>()
{
  using enum Quantity;
  using S = SnapshotKeys;
  static const std::vector<Parameter<S>> rows{
      member<S>("strains", &S::strains,
                {.quantity = fraction, .bound = from_to(0, 0.99), .default_text = "none"},
                "with a piston"),
      member<S>("times", &S::times,
                {.quantity = time, .bound = at_least(0), .default_text = "none"},
                "beside the strains, or without a piston"),
      member<S>("count", &S::count, {.bound = snapshot_count, .default_text = "7"},
                "evenly from start to end, without lists; 0: no snapshots"),
  };
  return rows;
}

bool Value<SnapshotKeys>::read(const Given& given, const Rule& rule, SnapshotKeys& keys)
{
  if (given.node.kind != Node::Kind::scalar) return read_map(given, keys, rule.dimensions);
  return Value<std::optional<int>>::read(given, {.bound = snapshot_count}, keys.count);
}

Node Value<SnapshotKeys>::write(const SnapshotKeys& keys, const Rule& rule)
{
  return write_map(keys, rule.dimensions);
}

std::string Value<SnapshotKeys>::describe(const Rule&)
{
  return "how many, or " + link_to(snapshots_section);
}

Json Value<SnapshotKeys>::schema(const Rule&)
{
  return {{"anyOf",
           {Value<int>::schema({.bound = snapshot_count}),
            Json{{"$ref", schema_reference(snapshots_section)}}}}};
}

}  // namespace mpm::scene
