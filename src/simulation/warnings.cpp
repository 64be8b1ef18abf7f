#include <mpm/micrograph/gaps.hpp>
#include <mpm/micrograph/picture.hpp>
#include <mpm/micrograph/wall_thickness.hpp>
#include <mpm/simulation/method.hpp>
#include <mpm/simulation/warnings.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

namespace mpm {

namespace {

/// Of the wall; less is what corners and round ends of thick walls have.
constexpr double thin_share = 0.01;
/// Of the piston over that of the fastest wave: nothing here describes what happens, and a slip of
/// the unit is likelier. What flies freely may be as soft as it likes.
constexpr double senseless_speed = 100;
/// A sudden start sends a wave of this strain through the specimen.
constexpr double sudden_strain = 1e-3;
constexpr double many_steps = 1e8;
/// Poisson's ratio from which a beam of four cells is half as stiff again as it should be, or more.
constexpr double locking_ratio = 0.45;
/// In cells: noise has grown tenfold or more (docs/stability.md).
constexpr double long_flight = 30;

/// Crushing, in which gaps close, and what their early contact may take of the strain.
constexpr double crushing_strain = 0.1, early_strain = 0.01;

using Warnings = std::vector<std::string>;

template <int Dim>
void look_at_thin_walls(const scene::Scene& scene, const micrograph::Specimen<Dim>& specimen,
                        const micrograph::Share& share, Warnings& warnings)
{
  const auto count = micrograph::count_thin(specimen, std::span(scene.materials),
                                            micrograph::thin_wall_cells, share);
  const double thin = double(count.thin) / double(std::max<GlobalIndex>(count.filled, 1));
  if (thin > thin_share)
    warnings.push_back(
        fmt::format("{:.0f} % of the wall is thinner than two cells: too stiff in bending by tens "
                    "of percent. Refine grid.cells, or quote no figure without a finer run.",
                    100 * thin));
}

template <int Dim>
void look_at_growth(const micrograph::Specimen<Dim>& specimen, Warnings& warnings)
{
  if (!specimen.picture() || specimen.picture()->growth == 0) return;
  const double growth = specimen.picture()->growth;
  warnings.push_back(
      fmt::format("no threshold of the picture gives the density asked for: its walls were made {} "
                  "by {:.2g} um all around. Check the picture, specimen.wall and the density, or "
                  "accept it.",
                  growth > 0 ? "thicker" : "thinner", 1e6 * std::abs(growth)));
}

template <int Dim>
void look_at_density(const micrograph::Specimen<Dim>& specimen, Warnings& warnings)
{
  if (!specimen.picture()) return;
  if (specimen.particles() == specimen.locations())
    warnings.push_back(
        "all of the picture is wall: there is no lumen to close. Look at specimen.threshold and "
        "specimen.wall, and at the picture.");
  if (specimen.picture()->aim == 0) return;
  const double aim = specimen.picture()->aim;
  const double found = double(specimen.particles()) / double(specimen.locations());
  if (std::abs(found - aim) <= micrograph::density_tolerance) return;
  warnings.push_back(fmt::format(
      "the relative density is {:.3g}, not the {:.3g} that specimen.threshold asks for: "
      "no threshold comes nearer, as pieces that are removed come and go as wholes. "
      "Lower specimen.remove_specks, or refine grid.cells.",
      found, aim));
}

template <int Dim>
void look_at_pieces(const micrograph::Specimen<Dim>& specimen, Warnings& warnings)
{
  if (!specimen.picture() || specimen.picture()->unconnected == 0) return;
  warnings.push_back(
      fmt::format("{:.2g} % of the wall ({} of {} particles) is in pieces that do not hang on the "
                  "largest: they "
                  "fly about until they are caught. Set specimen.remove_unconnected: true.",
                  100 * double(specimen.picture()->unconnected) / double(specimen.particles()),
                  specimen.picture()->unconnected, specimen.particles()));
}

/// Whatever is pushed is pushed on by what lies between, so that only whole empty layers part
/// particles from the piston.
template <int Dim>
void look_at_reach(const scene::Scene& scene, const micrograph::Specimen<Dim>& specimen,
                   const Layout<Dim>& layout, std::vector<double> layers, Warnings& warnings)
{
  const auto& loading = std::get<scene::Loading>(scene.motion);
  const int axis = axis_of(loading.piston);
  if (upper_of(loading.piston)) std::ranges::reverse(layers);
  const double travel = loading.strain * specimen.size()[axis];
  double gap = 0, unmet = 0;
  for (const double layer : layers) {
    if (layer == 0) gap += layout.location_size[axis];
    if (gap >= travel) unmet += layer;
  }
  if (gap >= travel && unmet == std::reduce(layers.begin(), layers.end()))
    micrograph::throw_in_scene(
        scene,
        fmt::format("the piston, which travels {:.4g} mm, never meets the specimen: there is "
                    "nothing in its way. Raise loading.strain, let it come from another "
                    "side (loading.piston), or crop the specimen.",
                    1e3 * travel));
  if (unmet > 0)
    warnings.push_back(fmt::format(
        "the piston, which travels {:.4g} mm, never meets {:.0f} of {} particles: there are {:.4g} "
        "mm of empty layers on the way to the last of them. Crop the specimen, or raise "
        "loading.strain.",
        1e3 * travel, unmet, specimen.particles(), 1e3 * gap));
}

/// With a piston the end is known once the specimen is.
template <int Dim>
void look_at_snapshots(const scene::Scene& scene, const Layout<Dim>& layout)
{
  const std::vector<double>& times = scene.output.snapshot_times;
  for (std::size_t k = 0; k < times.size(); ++k)
    if (times[k] > layout.end_time * (1 + 1e-9))
      micrograph::throw_in_scene(
          scene, fmt::format("output.snapshots.times[{}] is {:.4g} s (the run ends at {:.4g} s). "
                             "Lower it or raise loading.strain.",
                             k, times[k], layout.end_time));
}

/// Bodies in one velocity field touch before they meet.
template <int Dim>
void look_at_contact(const scene::Scene& scene, const micrograph::Specimen<Dim>& specimen,
                     const Layout<Dim>& layout, double early, Warnings& warnings)
{
  const auto& loading = std::get<scene::Loading>(scene.motion);
  const int axis = axis_of(loading.piston);
  if (loading.strain < crushing_strain) return;
  if (early <= early_strain) return;
  warnings.push_back(fmt::format(
      "contact closes gaps about a cell too early: {:.1f} of them on the piston's way are "
      "{:.1f} % of strain once all are closed. Half the cell, half of that: refine grid.cells, or "
      "let mpm_study --error-bar estimate the error. With numerics.formulation: total_lagrangian "
      "cells meet where they are, and wood comes to the same error in a fraction of the run time "
      "(docs/formulations.md).",
      early * specimen.size()[axis] / layout.geometry.spacing[axis], 100 * early));
}

template <int Dim>
void look_at_bodies_in_contact(const scene::Scene& scene, const micrograph::Specimen<Dim>& specimen,
                               Warnings& warnings)
{
  for (std::size_t k = 0; k < scene.contacts.size(); ++k)
    for (const std::string& name : scene.contacts[k].between) {
      const auto material = std::ranges::find(scene.materials, name, &scene::Material::name);
      const auto index = std::size_t(material - scene.materials.begin());
      if (index < scene.materials.size() && specimen.particles_of_material()[index] == 0)
        warnings.push_back(fmt::format(
            "contact[{}] is between {} and {}, and there are no particles of {}: it has no effect. "
            "Look at the picture and the shapes.",
            k, scene.contacts[k].between[0], scene.contacts[k].between[1], name));
    }
}

template <int Dim>
void look_at_speed(const scene::Scene& scene, const micrograph::Specimen<Dim>& specimen,
                   const Layout<Dim>& layout, Warnings& warnings)
{
  const auto* loading = std::get_if<scene::Loading>(&scene.motion);
  const double speed = layout.largest_speed, wave = layout.wave_speed;
  if (loading && loading->speed >= senseless_speed * wave)
    micrograph::throw_in_scene(
        scene,
        fmt::format("the piston's speed, {:.4g} m/s, is more than {} times that of the fastest "
                    "wave, {:.4g} m/s. Lower loading.speed.",
                    loading->speed, senseless_speed, wave));
  if (speed >= wave) {
    warnings.push_back(fmt::format(
        "the largest speed, {:.4g} m/s, is not below that of the fastest wave, {:.4g} m/s: "
        "everything it meets is a shock, for which no law here is made. Lower it.",
        speed, wave));
  } else if (loading && loading->speed > quasi_static_speed * wave) {
    warnings.push_back(fmt::format(
        "the piston's speed, {:.4g} m/s, is above the quasi-static range, {:.2g} m/s ({} of the "
        "fastest wave): stress_piston and stress_edge will differ. Lower loading.speed.",
        loading->speed, quasi_static_speed * wave, quasi_static_speed));
  } else if (loading && loading->speed > sudden_strain * wave &&
             layout.piston.ramp_time < specimen.size()[axis_of(loading->piston)] / wave) {
    warnings.push_back(fmt::format(
        "the piston is at its speed before the fastest wave has crossed the specimen, which takes "
        "{:.2g} s: a wave of {:.2g} % strain runs to and fro. Leave loading.ramp_time out.",
        specimen.size()[axis_of(loading->piston)] / wave, 100 * loading->speed / wave));
  }
}

/// Gradients that jump at cell borders (they allow no affine field) make noise, which only
/// velocities that are mapped back, or forces that go first, keep small.
void look_at_order(const scene::Numerics& numerics, Warnings& warnings)
{
  const UpdateOrderRow& order = *numerics.update_order;
  if (!numerics.shape_function->stable_cfl.affine && !order.remaps && !order.stable_cfl)
    warnings.push_back(fmt::format(
        "{} shape functions with {} break down in crushing above a CFL of 0.18: the noise of "
        "crossing cells grows. Take numerics.update_order: musl, or other shape functions.",
        numerics.shape_function->keyword, order.keyword));
}

/// What cannot change its volume cell by cell bends too stiffly.
void look_at_locking(const scene::Scene& scene, Warnings& warnings)
{
  if (scene.numerics.f_bar || scene.numerics.plane == scene::Plane::stress) return;
  for (const scene::Material& material : scene.materials) {
    if (!material.law->has("poisson_ratio")) continue;
    const double ratio = material.values.number("poisson_ratio");
    if (ratio <= locking_ratio) continue;
    warnings.push_back(
        fmt::format("Poisson's ratio of '{}', {:.4g}, is near 1/2: where walls are few cells thick "
                    "it locks and "
                    "bends too stiffly. Set numerics.f_bar: true.",
                    material.name, ratio));
  }
}

/// Particles that take increments keep the noise that crossing cells makes.
template <int Dim>
void look_at_flight(const scene::Scene& scene, const Layout<Dim>& layout, Warnings& warnings)
{
  const scene::Numerics& numerics = scene.numerics;
  if (!std::holds_alternative<scene::FreeMotion>(scene.motion) ||
      reaction_book(numerics) != ReactionBook::increments || numerics.update_order->stable_cfl)
    return;
  const double end =
      std::min(layout.end_time, expected_steps(scene, layout) * time_step_of(layout).first());
  const double cells = layout.largest_speed * end / layout.geometry.smallest_spacing();
  if (cells > long_flight)
    warnings.push_back(fmt::format(
        "at {:.4g} m/s something may cross {:.0f} cells in this run: each makes noise, which {} "
        "keeps and which grows in free flight and rotation. Take gimp or quadratic with scheme "
        "apic or tpic.",
        layout.largest_speed, cells, numerics.scheme->keyword));
}

}  // namespace

template <int Dim>
std::vector<std::string> warnings_of(const scene::Scene& scene,
                                     const micrograph::Specimen<Dim>& specimen,
                                     const Layout<Dim>& layout, const micrograph::Share& share)
{
  Warnings warnings;
  const bool on_a_grid = !is_total_lagrangian(scene.numerics);
  if (on_a_grid) look_at_thin_walls(scene, specimen, share, warnings);
  look_at_growth(specimen, warnings);
  look_at_density(specimen, warnings);
  look_at_pieces(specimen, warnings);
  look_at_speed(scene, specimen, layout, warnings);
  if (on_a_grid) {
    look_at_order(scene.numerics, warnings);
    look_at_locking(scene, warnings);
    look_at_flight(scene, layout, warnings);
  }
  look_at_bodies_in_contact(scene, specimen, warnings);
  if (const auto* loading = std::get_if<scene::Loading>(&scene.motion)) {
    look_at_snapshots(scene, layout);
    micrograph::Gaps gaps = micrograph::gaps_along(specimen, std::span(scene.materials),
                                                   axis_of(loading->piston), share);
    if (on_a_grid) look_at_contact(scene, specimen, layout, gaps.early_contact, warnings);
    look_at_reach(scene, specimen, layout, std::move(gaps.layers), warnings);
  }
  if (const auto limit = stable_cfl_of(scene.numerics); limit && layout.cfl > *limit)
    warnings.push_back(
        fmt::format("numerics.cfl is {:.3g}, beyond {:.3g}, the limit of {}: noise will grow. "
                    "Leave it out: the default keeps a margin.",
                    layout.cfl, *limit, limited_by(scene.numerics)));
  if (const double steps = expected_steps(scene, layout); steps > many_steps)
    warnings.push_back(
        fmt::format("the run takes {:.2g} steps or more, over which rounding adds up. Raise the "
                    "speed within the quasi-static range, or take fewer grid.cells.",
                    steps));
  return warnings;
}

template std::vector<std::string> warnings_of(const scene::Scene&, const micrograph::Specimen<2>&,
                                              const Layout<2>&, const micrograph::Share&);
template std::vector<std::string> warnings_of(const scene::Scene&, const micrograph::Specimen<3>&,
                                              const Layout<3>&, const micrograph::Share&);

}  // namespace mpm
