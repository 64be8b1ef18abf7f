#include <mpm/parallel/session.hpp>
#include <mpm/simulation/load_balance.hpp>

#include <algorithm>

namespace mpm {

namespace {

constexpr double bound = 1.03;
constexpr int checks_in_a_row = 8;
/// Steps until the next attempt after one that did not pay.
constexpr GlobalIndex steps_of_patience = 500;
/// How far the cost of a particle may be from the mean: on a rank with few particles the nodes cost
/// more than they do.
constexpr double largest_cost = 1.5;
/// Costs are compared while no rank has more than so many times the mean's particles.
constexpr double comparable = 1.1;
/// Steps that a gain is counted for at least.
constexpr GlobalIndex shortest_horizon = 1000;

template <int Dim, class Visit>
void for_each_cell_of(const Stepper<Dim>& stepper, Visit visit)
{
  const GridGeometry<Dim>& geometry = stepper.decomposition().geometry();
  for (const Body<Dim>& body : stepper.bodies())
    for (LocalIndex p = 0; p < body.particles.size(); ++p) {
      Vec<Dim> position;
      for (int d = 0; d < Dim; ++d) position[d] = body.particles.motion()(d, p);
      visit(geometry.cell_of(position));
    }
}

template <int Dim>
struct Choice {
  Partition<Dim> next;
  double imbalance_now;  ///< of the same loads under the present map
};

/// What the present particles ask for. Collective.
template <int Dim>
Choice<Dim> present_choice(const Stepper<Dim>& stepper, const PartitionRules<Dim>& rules,
                           double particle_cost)
{
  const Decomposition<Dim>& now = stepper.decomposition();
  WorkMap<Dim> work(now.geometry(), now.ranks());
  const auto particles = [&](const auto& visit) { for_each_cell_of(stepper, visit); };
  particles([&](const IndexVec<Dim>& cell) { work.add(cell, particle_cost); });
  work.sum_over_ranks(now.comm());
  const auto loads_under = [&](const Ownership<Dim>& ownership) {
    std::vector<double> loads = loads_of<Dim>(ownership, particles);
    for (double& load : loads) load *= particle_cost;
    sum_over_ranks(now.comm(), loads);
    return loads;
  };
  return {choose_partition<Dim>(now.geometry(), now.ranks(), rules, work, loads_under,
                                &now.ownership()),
          imbalance_of(loads_under(now.ownership()))};
}

}  // namespace

template <int Dim>
void LoadBalance<Dim>::look(Stepper<Dim>& stepper)
{
  if (stepper.decomposition().ranks() == 1) return;
  if (stepper.steps() % Stepper<Dim>::steps_between_checks == 0) observe(stepper);
  if (!is_due(stepper)) return;
  checks_above_ = 0;
  if (!move_borders(stepper)) not_before_ = stepper.steps() + steps_of_patience;
}

template <int Dim>
void LoadBalance<Dim>::observe(const Stepper<Dim>& stepper)
{
  const typename Stepper<Dim>::Agreed& agreed = stepper.agreed();
  imbalance_sum_ += agreed.imbalance();
  work_sum_ += agreed.work_imbalance();
  ++checks_;
  if (interval_ > 0) return;
  if (agreed.imbalance() > comparable || stepper.particles() == 0) {
    particle_cost_ = 1;
    return;
  }
  const double own = agreed.own_seconds / stepper.particles();
  const double mean = agreed.mean_seconds / agreed.mean_particles;
  particle_cost_ = mean > 0 ? std::clamp(own / mean, 1 / largest_cost, largest_cost) : 1;
}

template <int Dim>
bool LoadBalance<Dim>::is_due(const Stepper<Dim>& stepper)
{
  if (interval_ > 0) return stepper.steps() % interval_ == 0;
  if (stepper.steps() % Stepper<Dim>::steps_between_checks != 0) return false;
  checks_above_ = stepper.agreed().work_imbalance() > bound ? checks_above_ + 1 : 0;
  return checks_above_ >= checks_in_a_row && stepper.steps() >= not_before_;
}

template <int Dim>
bool LoadBalance<Dim>::move_borders(Stepper<Dim>& stepper)
{
  const MPI_Comm comm = stepper.decomposition().comm();
  const double start = MPI_Wtime();
  const Choice<Dim> choice = present_choice(stepper, rules_, particle_cost_);
  if (interval_ == 0) {
    const double saved =
        (choice.imbalance_now - choice.next.imbalance()) * stepper.agreed().mean_seconds;
    const GlobalIndex horizon = std::max(shortest_horizon, stepper.steps() - last_);
    if (saved <= 0 || saved * double(horizon) < cost_) return false;
  }
  stepper.repartition(choice.next.ownership);
  cost_ = largest_over_ranks(comm, MPI_Wtime() - start);
  last_ = stepper.steps();
  ++repartitions_;
  return true;
}

template class LoadBalance<2>;
template class LoadBalance<3>;

}  // namespace mpm
