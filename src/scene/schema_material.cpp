#include <mpm/scene/schema.hpp>

#include <initializer_list>

namespace mpm::scene {

namespace {

Condition<Material> law(std::initializer_list<Law> laws)
{
  std::vector<std::string> names;
  for (const Law each : laws) names.emplace_back(name_of(each));
  return {[laws = std::vector(laws)](const Material& material) {
            return std::ranges::find(laws, material.law) != laws.end();
          },
          "law " + alternatives(names)};
}

}  // namespace

template <>
const std::vector<Parameter<Material>>& parameters<Material>()
{
  using enum Law;
  using enum Quantity;
  using M = Material;
  const Need required = Need::required;
  const auto elastic = law({isotropic, von_mises});
  const auto deformable = law({isotropic, transversely_isotropic, von_mises});
  const auto oriented = law({transversely_isotropic});
  const Condition<M> lying_axis{[](const M& m) {
                                  return m.law == transversely_isotropic &&
                                         m.unique_axis == UniqueAxis::in_plane;
                                },
                                "law transversely_isotropic with unique_axis in_plane"};

  static const std::vector<Parameter<M>> rows{
      member<M>("law", &M::law, {}, "how stress follows from strain"),
      member<M>("name", &M::name, {}, "for bands and shapes; needed with several materials"),
      member<M>("strain_measure", &M::strain_measure, {},
                "logarithmic (Hencky) strain, or a rate of small strain with rotation")
          .when(elastic),
      member<M>("density", &M::density, {.quantity = density, .bound = above(0), .need = required},
                "mass per volume of the solid")
          .when(deformable),
      member<M>("youngs_modulus", &M::youngs_modulus,
                {.quantity = pressure, .bound = above(0), .need = required},
                "Young's modulus; across the unique axis if transversely isotropic")
          .when(deformable),
      member<M>("poisson_ratio", &M::poisson_ratio, {.bound = between(-1, 0.5), .need = required},
                "Poisson's ratio")
          .when(elastic),
      member<M>("poisson_ratio", &M::poisson_ratio, {.bound = between(-1, 1), .need = required},
                "Poisson's ratio within the plane across the unique axis")
          .when(oriented),
      member<M>("yield_stress", &M::yield_stress,
                {.quantity = pressure, .bound = above(0), .need = required},
                "uniaxial yield stress")
          .when(law({von_mises})),
      member<M>("hardening_modulus", &M::hardening_modulus,
                {.quantity = pressure, .bound = at_least(0)},
                "slope of the yield stress over plastic strain; 0: perfectly plastic")
          .when(law({von_mises})),
      member<M>("axial_modulus", &M::axial_modulus,
                {.quantity = pressure, .bound = above(0), .need = required},
                "Young's modulus along the unique axis")
          .when(oriented),
      member<M>("axial_poisson_ratio", &M::axial_poisson_ratio, {.need = required},
                "contraction across over extension along the unique axis, loaded along it")
          .when(oriented),
      member<M>("axial_shear_modulus", &M::axial_shear_modulus,
                {.quantity = pressure, .bound = above(0), .need = required},
                "shear modulus in planes that hold the unique axis")
          .when(oriented),
      member<M>("unique_axis", &M::unique_axis, {},
                "whether the unique axis stands on the picture or lies in it")
          .when(oriented),
      member<M>("axis_angle", &M::axis_angle, {.quantity = angle},
                "from +x to the unique axis, counter-clockwise")
          .when(lying_axis),
      member<M>("velocity", &M::velocity, {.quantity = Quantity::velocity},
                "prescribed velocity [x, y]")
          .when(law({rigid})),
  };
  return rows;
}

}  // namespace mpm::scene
