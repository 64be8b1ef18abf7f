#include <mpm/scene/sides.hpp>
#include <mpm/simulation/method.hpp>
#include <mpm/simulation/plan.hpp>
#include <mpm/simulation/preparation.hpp>
#include <mpm/simulation/snapshots.hpp>

#include <algorithm>

#include <fmt/format.h>

namespace mpm {

namespace {

template <class Columns>
bool holds(const Columns& columns, std::string_view name)
{
  return std::ranges::any_of(columns, [&](const auto& column) { return column.name == name; });
}

bool particles_hold(const Plan& plan, std::string_view name)
{
  return std::ranges::any_of(
      plan.bodies, [&](const Plan::Particles& body) { return holds(body.columns, name); });
}

bool any_condition(const Plan& plan, std::string_view words)
{
  return std::ranges::any_of(plan.conditions, [&](const std::string& condition) {
    return condition.find(words) != std::string::npos;
  });
}

bool any_periodic(const scene::Scene& scene, int dimensions)
{
  for (int axis = 0; axis < dimensions; ++axis)
    if (scene::is_periodic(scene, axis)) return true;
  return false;
}

void leave_out_of_grid_step(const scene::Numerics& numerics, const Plan& plan,
                            std::vector<Plan::LeftOut>& list)
{
  const auto add_if = [&](bool absent, std::string what, std::string why) {
    if (absent) list.push_back({std::move(what), std::move(why)});
  };
  add_if(!particles_hold(plan, "deformation_gradient"), "deformation gradient", "no law needs it");
  add_if(!particles_hold(plan, "affine_velocity"), "affine velocity",
         fmt::format("not of scheme {}", numerics.scheme->keyword));
  add_if(!particles_hold(plan, domain_column), "particle domains",
         fmt::format("not of shape function {}", numerics.shape_function->keyword));
  add_if(!particles_hold(plan, "grid_velocity"), "grid velocity of particles",
         fmt::format("{} moves them as it reads it", numerics.update_order->keyword));
  add_if(!holds(plan.nodes.columns, "remapped_momentum"), "re-mapped momentum",
         fmt::format("{} maps no velocity back", numerics.update_order->keyword));
  const StepExtras extras = extras_of(numerics);
  add_if(extras.refinements == 0, "refinements of velocity",
         fmt::format("not of scheme {}", numerics.scheme->keyword));
  add_if(!extras.f_bar, "means of the divergence", "numerics.f_bar is false");
}

}  // namespace

template <int Dim>
std::vector<Plan::LeftOut> left_out(const Preparation<Dim>& preparation, const Plan& plan)
{
  const scene::Scene& scene = preparation.scene;
  const scene::Numerics& numerics = scene.numerics;
  const auto* loading = std::get_if<scene::Loading>(&scene.motion);
  std::vector<Plan::LeftOut> list;
  const auto add_if = [&](bool absent, std::string what, std::string why) {
    if (absent) list.push_back({std::move(what), std::move(why)});
  };
  add_if(Dim == 2, "third component", "the scene lies in the plane");
  add_if(!particles_hold(plan, "plastic_strain"), "plastic strain and work",
         "no material can yield");
  if (is_total_lagrangian(numerics))
    list.insert(list.end(), {{"sorting and migration", "cells keep their neighbours"},
                             {"stencils and weights", "they never change"},
                             {"empty nodes", "there is none without a cell"},
                             {"re-mapped momentum", "velocities stay on the nodes"}});
  else
    leave_out_of_grid_step(numerics, plan, list);
  add_if(is_total_lagrangian(numerics) && numerics.contact_stiffness == 0, "contact",
         "numerics.contact_stiffness is 0");
  add_if(!particles_hold(plan, "initial_position"), "first places",
         "no exact solution, no load that follows them");
  add_if(plan.loads.empty(), "loads and their forces", "the scene names none");
  add_if(scene.contacts.empty(), "contact between bodies", "the scene names none");
  add_if(loading && plan.conditions.size() == 2, "walls beside the travel", "no side is one");
  add_if(!loading && plan.conditions.empty(), "walls", "no side is one");
  add_if(!any_periodic(scene, Dim), "periodic images", "no side is periodic");
  add_if(loading && !loading->load_cell, "load cell", "the scene names none");
  add_if(!any_condition(plan, "rigid body"), "rigid bodies", "no material is rigid");
  add_if(!asks_for_snapshots(scene), "snapshots and HDF5", "no strain or time is named");
  add_if(!scene.exact_solution, "exact solution", "the scene names none");
  add_if(plan.messages_per_step == 0, "messages", "one rank");
  return list;
}

template std::vector<Plan::LeftOut> left_out(const Preparation<2>&, const Plan&);
template std::vector<Plan::LeftOut> left_out(const Preparation<3>&, const Plan&);

}  // namespace mpm
