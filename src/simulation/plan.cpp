#include <mpm/lagrangian/location_mesh.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/parallel/shared_nodes.hpp>
#include <mpm/scene/sides.hpp>
#include <mpm/simulation/body_contacts.hpp>
#include <mpm/simulation/mesh_count.hpp>
#include <mpm/simulation/method.hpp>
#include <mpm/simulation/model.hpp>
#include <mpm/simulation/plan.hpp>
#include <mpm/simulation/preparation.hpp>

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace mpm {

namespace {

template <class Columns>
int sum_of_bytes(const Columns& columns)
{
  int bytes = 0;
  for (const auto& column : columns) bytes += column.bytes;
  return bytes;
}

template <int Dim>
Plan::Particles particles_of(const scene::Material& material, double count,
                             const scene::Scene& scene, int particles_per_cell)
{
  const auto law = law_of<Dim>(material, scene);
  const ParticleStore store = empty_store(scene, particles_per_cell, *law, loads_of<Dim>(scene));
  Plan::Particles particles{
      material.name, count, law->wave_speed(), material.density(), {{"id", sizeof(GlobalIndex)}}};
  for (const ColumnGroup* group : {&store.motion(), &store.state()})
    for (const Column& column : group->columns())
      particles.columns.push_back({column.name, int(sizeof(double)) * column.components});
  return particles;
}

template <int Dim>
std::vector<Plan::Particles> bodies_of(const Preparation<Dim>& preparation, int particles_per_cell)
{
  const scene::Scene& scene = preparation.scene;
  std::vector<Plan::Particles> bodies;
  for (std::size_t k = 0; k < scene.materials.size(); ++k) {
    const auto count = double(preparation.specimen.particles_of_material()[k]);
    if (scene.materials[k].law->deformable() && count > 0)
      bodies.push_back(particles_of<Dim>(scene.materials[k], count, scene, particles_per_cell));
  }
  if (const auto& cell = preparation.layout.load_cell)
    bodies.push_back(particles_of<Dim>(load_cell_material(scene, cell->density_ratio),
                                       double(cell->locations.size()), scene, particles_per_cell));
  return bodies;
}

template <int Dim>
Plan::Nodes nodes_of(const Preparation<Dim>& preparation, int support)
{
  const Ownership<Dim>& ownership = preparation.partition.ownership;
  const scene::Numerics& numerics = preparation.scene.numerics;
  const auto needs =
      node_needs<Dim>(*numerics.update_order, extras_of(numerics), loads_of<Dim>(preparation.scene),
                      !preparation.scene.contacts.empty());
  Plan::Nodes nodes{.in_grid = ownership.geometry().nodes.template cast<double>().prod(),
                    .allocated = 0,
                    .largest_rank = 0,
                    .reach = StencilReach(support),
                    .columns = node_columns<Dim>(needs)};
  for (int rank = 0; rank < ownership.ranks(); ++rank) {
    const double box = double(ownership.local(rank, support).size());
    nodes.allocated += box;
    nodes.largest_rank = std::max(nodes.largest_rank, box);
  }
  return nodes;
}

int velocity_fields(const scene::Scene& scene, const Plan& plan)
{
  std::vector<std::string> names;
  for (const Plan::Particles& body : plan.bodies) names.push_back(body.body);
  return std::ranges::max(fields_of_bodies(scene, names)) + 1;
}

/// "left: piston", ... in the order in which the model has them.
template <int Dim>
std::vector<std::string> conditions_of(const Preparation<Dim>& preparation)
{
  const scene::Scene& scene = preparation.scene;
  std::vector<std::string> list;
  for (std::size_t k = 0; k < scene.materials.size(); ++k)
    if (!scene.materials[k].law->deformable() && preparation.specimen.particles_of_material()[k])
      list.push_back(fmt::format("{}: rigid body", scene.materials[k].name));
  if (const auto* loading = std::get_if<scene::Loading>(&scene.motion)) {
    const int axis = axis_of(loading->piston);
    const bool upper = upper_of(loading->piston);
    list.push_back(fmt::format("{}: piston", side_words[std::size_t(2 * axis + upper)]));
    list.push_back(fmt::format("{}: fixed edge", side_words[std::size_t(2 * axis + !upper)]));
  }
  for (int axis = 0; axis < Dim; ++axis)
    for (const bool upper : {false, true})
      if (const auto side = scene::side_of(scene, axis, upper); side && (*side)->is_wall())
        list.push_back(
            fmt::format("{}: {}", side_words[std::size_t(2 * axis + upper)], (*side)->keyword));
  if (const auto* free = std::get_if<scene::FreeMotion>(&scene.motion))
    for (const scene::MovingSide& moving : free->moving_sides)
      list.push_back(fmt::format("{}: moving wall", side_words[std::size_t(moving.side)]));
  return list;
}

/// Of each node and each cell of a mesh. Collective.
template <int Dim>
void plan_mesh(const Preparation<Dim>& preparation, Plan& plan)
{
  const Loads<Dim> loads = loads_of<Dim>(preparation.scene);
  const int rank = rank_of(preparation.comm);
  const std::vector<MeshCount> counts =
      count_mesh(preparation.scene, preparation.specimen, preparation.layout,
                 preparation.partition.ownership, preparation.comm);
  plan.nodes = {
      .in_grid = (preparation.specimen.count().array() + 1).template cast<double>().prod(),
      .allocated = 0,
      .largest_rank = 0,
      .reach = std::nullopt,
      .columns = mesh_node_columns<Dim>(mesh_needs<Dim>(!loads.empty()))};
  for (const MeshCount& count : counts) {
    plan.nodes.allocated += count.nodes;
    plan.nodes.largest_rank = std::max(plan.nodes.largest_rank, count.nodes);
    plan.hinges += count.hinges;
    if (contact_stiffness(preparation.scene.numerics) > 0)
      plan.contact_cells += count.contact_cells;
  }
  const auto& contacts = preparation.scene.contacts;
  if (std::ranges::any_of(contacts, [](const auto& contact) { return contact.friction > 0; }))
    plan.nodes.columns.push_back({"friction", Dim * int(sizeof(double))});
  const auto is_rigid = [](const std::string& condition) {
    return condition.ends_with("rigid body");
  };
  if (std::ranges::any_of(plan.conditions, is_rigid))
    plan.nodes.columns.push_back({"led", sizeof(char)});
  constexpr int corners = LocationMesh<Dim>::corners;
  for (Plan::Particles& body : plan.bodies)
    body.columns.insert(body.columns.end(), {{"corners", corners * int(sizeof(LocalIndex))},
                                             {"corner_forces", corners * Dim * int(sizeof(double))},
                                             {"corner_bounds", 2 * int(sizeof(double))},
                                             {"least_stretch", int(sizeof(double))}});
  const auto& materials = preparation.scene.materials;
  const bool surfaces_change =
      contact_stiffness(preparation.scene.numerics) > 0 &&
      std::ranges::any_of(materials, [](const auto& material) { return bool(material.failure); });
  const bool fitted = preparation.scene.numerics.surface == scene::Surface::fitted;
  if (fitted && (surfaces_change || counts.size() > 1))
    plan.nodes.columns.push_back({"at_rest", CornerOffsets<Dim>::bytes_of_corner});
  if (fitted)
    for (Plan::Particles& body : plan.bodies)
      for (const scene::Material& material : materials)
        if (material.name == body.body && material.failure && material.failure->stretch)
          body.columns.push_back({"rest_deformation", Dim * Dim * int(sizeof(double))});
  PassOutline& pass = plan.passes.emplace_back();
  pass.name = "cells";
  pass.sums = {"force"};
  if (loads.act_on_particles()) pass.sums.push_back("load_force");
  pass.values_per_node = Dim * int(pass.sums.size());
  const MeshCount& mine = counts[std::size_t(rank)];
  std::array<double, 2> largest{
      mine.sharers,
      double(sizeof(double)) * (pass.values_per_node * mine.sent_nodes + mine.sharers)};
  largest_over_ranks(preparation.comm, largest);
  plan.messages_per_step = largest[0];
  plan.bytes_per_step = largest[1];
}

/// Collective.
template <int Dim>
void measure_messages(const Preparation<Dim>& preparation, int support, Plan& plan)
{
  const SharedNodes shared =
      find_shared_nodes(preparation.partition.ownership, support, rank_of(preparation.comm));
  // Each message carries a number beside the sums.
  double values = 0;
  for (const PassOutline& pass : plan.passes)
    values +=
        double(pass.values_per_node) * double(shared.sent_nodes()) + double(shared.sharers.size());
  std::array<double, 2> largest{double(plan.passes.size() * shared.sharers.size()),
                                double(sizeof(double)) * values};
  largest_over_ranks(preparation.comm, largest);
  plan.messages_per_step = largest[0];
  plan.bytes_per_step = largest[1];
}

}  // namespace

int Plan::Particles::bytes() const
{
  return sum_of_bytes(columns);
}

int Plan::Nodes::bytes() const
{
  return sum_of_bytes(columns);
}

double Plan::particles() const
{
  double count = 0;
  for (const Particles& body : bodies) count += body.count;
  return count;
}

int Plan::bytes_per_particle() const
{
  int most = 0;
  for (const Particles& body : bodies) most = std::max(most, body.bytes());
  return most;
}

double Plan::bytes() const
{
  double sum = nodes.allocated * nodes.bytes();
  for (const Particles& body : bodies) sum += body.count * body.bytes();
  return sum;
}

template <int Dim>
Plan make_plan(const Preparation<Dim>& preparation)
{
  const scene::Scene& scene = preparation.scene;
  const scene::Numerics& numerics = scene.numerics;
  Plan plan;
  plan.method = method_words(numerics, Dim);
  plan.bodies = bodies_of(preparation, preparation.layout.per_cell);
  plan.conditions = conditions_of(preparation);
  if (is_total_lagrangian(numerics)) {
    plan_mesh(preparation, plan);
  } else {
    const int support = make_transfer<Dim>(numerics, preparation.layout.per_cell)->support();
    plan.nodes = nodes_of(preparation, support);
    plan.passes =
        outline_step<Dim>(numerics.update_order, extras_of(numerics),
                          loads_of<Dim>(scene).act_on_particles(), !scene.contacts.empty());
    const int fields = velocity_fields(scene, plan);
    for (PassOutline& pass : plan.passes) pass.values_per_node *= fields;
    for (NodeBytes& column : plan.nodes.columns)
      if (column.name != "marks") column.bytes *= fields;
    measure_messages(preparation, support, plan);
  }
  for (const scene::Load& load : scene.loads)
    plan.loads.push_back(load.kind->keyword + ": " + load.kind->help);
  plan.left_out = left_out(preparation, plan);
  plan.time_step = time_step_of(preparation.layout).first();
  plan.steps = expected_steps(scene, preparation.layout);
  plan.end_time = plan.steps * plan.time_step;
  return plan;
}

template Plan make_plan(const Preparation<2>&);
template Plan make_plan(const Preparation<3>&);

}  // namespace mpm
