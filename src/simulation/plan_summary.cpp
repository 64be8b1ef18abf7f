#include <mpm/simulation/plan.hpp>

namespace mpm {

void describe(const Plan& plan, output::Summary& summary)
{
  summary.set("method", plan.method);
  summary.set("bytes", plan.bytes());
  summary.set("bytes_per_particle", plan.bytes_per_particle());
  summary.set("bytes_per_node", plan.nodes.bytes());
  for (const Plan::Particles& body : plan.bodies) {
    output::Summary& of_body = summary.section("particles").section(body.body);
    of_body.set("count", std::int64_t(body.count));
    for (const Plan::ParticleColumn& column : body.columns)
      of_body.section("bytes").set(column.name, column.bytes);
  }
  output::Summary& nodes = summary.section("nodes");
  nodes.set("in_grid", std::int64_t(plan.nodes.in_grid));
  nodes.set("allocated", std::int64_t(plan.nodes.allocated));
  nodes.set("largest_rank", std::int64_t(plan.nodes.largest_rank));
  if (plan.nodes.reach) {
    nodes.set("updated_below_cell", plan.nodes.reach->below);
    nodes.set("updated_above_cell", plan.nodes.reach->above);
  }
  for (const NodeBytes& column : plan.nodes.columns)
    nodes.section("bytes").set(column.name, column.bytes);
  if (plan.contact_cells > 0) summary.set("contact_cells", std::int64_t(plan.contact_cells));
  if (!plan.nodes.reach) summary.set("hinges", std::int64_t(plan.hinges));
  std::vector<std::string> passes;
  std::vector<std::int64_t> values;
  for (const PassOutline& pass : plan.passes) {
    passes.push_back(pass.name);
    values.push_back(pass.values_per_node);
    summary.section("sums").set(pass.name, pass.sums);
  }
  summary.set("passes", std::move(passes));
  summary.set("values_per_shared_node", std::move(values));
  summary.set("messages_per_step", plan.messages_per_step);
  summary.set("bytes_per_step", plan.bytes_per_step);
  summary.set("conditions", plan.conditions);
  summary.set("loads", plan.loads);
  for (const Plan::LeftOut& absent : plan.left_out)
    summary.section("left_out").set(absent.what, absent.why);
  summary.set("time_step", plan.time_step);
  summary.set("steps", plan.steps);
  summary.set("end_time", plan.end_time);
}

}  // namespace mpm
