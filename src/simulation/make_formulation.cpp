#include <mpm/lagrangian/total_lagrangian.hpp>
#include <mpm/simulation/body_contacts.hpp>
#include <mpm/simulation/method.hpp>
#include <mpm/simulation/model.hpp>
#include <mpm/stepping/updated_lagrangian.hpp>

namespace mpm {

namespace {

/// Of each body; a load cell, which is of no material, does not fail.
template <int Dim>
std::vector<FailureLimits> failure_limits(const scene::Scene& scene,
                                          const std::vector<Body<Dim>>& bodies)
{
  if (!cells_may_fail(scene)) return {};
  const auto& materials = scene.materials;
  std::vector<FailureLimits> limits(bodies.size());
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const auto material = std::size_t(bodies[b].material);
    if (material >= materials.size() || !materials[material].failure) continue;
    const scene::Failure& failure = *materials[material].failure;
    limits[b].plastic_strain = failure.plastic_strain.value_or(limits[b].plastic_strain);
    limits[b].stretch = failure.stretch.value_or(limits[b].stretch);
  }
  return limits;
}

}  // namespace

template <int Dim>
std::unique_ptr<Formulation<Dim>> make_formulation(const scene::Scene& scene,
                                                   const Layout<Dim>& layout,
                                                   const Decomposition<Dim>& decomposition,
                                                   Model<Dim>&& model)
{
  if (is_total_lagrangian(scene.numerics)) {
    std::vector<std::string> names;
    for (const Body<Dim>& body : model.bodies) names.push_back(body.name);
    for (const RigidCells<Dim>& rigid : model.rigid) names.push_back(rigid.name);
    std::vector<FailureLimits> failure = failure_limits(scene, model.bodies);
    return std::make_unique<TotalLagrangian<Dim>>(
        decomposition,
        typename TotalLagrangian<Dim>::Setup{
            std::move(model.bodies), std::move(model.slots), layout.location_size,
            scene.numerics.thickness, contact_stiffness(scene.numerics),
            pairs_of_bodies(scene, names), mass_scaling_of(scene), std::move(model.offsets),
            std::move(model.rigid), std::move(failure), time_step_of(layout).first()});
  }
  typename UpdatedLagrangian<Dim>::Setup setup;
  setup.transfer = make_transfer<Dim>(scene.numerics, layout.per_cell);
  setup.order = scene.numerics.update_order;
  setup.bodies = std::move(model.bodies);
  setup.slots = std::move(model.slots);
  setup.mass_cut = 1e-24 * layout.largest_particle_mass;
  setup.extras = extras_of(scene.numerics);
  return std::make_unique<UpdatedLagrangian<Dim>>(decomposition, std::move(setup));
}

template std::unique_ptr<Formulation<2>> make_formulation(const scene::Scene&, const Layout<2>&,
                                                          const Decomposition<2>&, Model<2>&&);
template std::unique_ptr<Formulation<3>> make_formulation(const scene::Scene&, const Layout<3>&,
                                                          const Decomposition<3>&, Model<3>&&);

}  // namespace mpm
