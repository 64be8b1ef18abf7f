#include <cmath>

#include "load_parameters.hpp"

namespace mpm {

namespace {

/// Takes momentum from every node at a rate c, exactly over a step of any length:
/// f_i = -(mv)_i (1 - exp(-c dt)) / dt.
template <int Dim>
class Damping final : public Load<Dim> {
 public:
  explicit Damping(double rate) : rate_(rate) {}

  bool acts_on_particles() const override { return false; }
  void add_to_nodes(const Nodes<Dim>&, std::span<const NodeRun<Dim>> runs, NodeFields<Dim>& fields,
                    double, double dt) const override
  {
    const double share = std::expm1(-rate_ * dt) / dt;
    const NodeColumn momentum = fields.momentum_column();
    for (const NodeRun<Dim>& run : runs)
      for (LocalIndex node = run.first; node < run.first + run.length; ++node) {
        if (!(fields.loaded_mass_of(node) > 0)) continue;
        for (int d = 0; d < Dim; ++d)
          fields.load_force[std::size_t(node) * Dim + d] +=
              share * momentum.values[std::size_t(node) * momentum.stride + d];
      }
  }

 private:
  double rate_;
};

template <int Dim>
std::unique_ptr<Load<Dim>> make(const ParameterValues& v, int)
{
  return std::make_unique<Damping<Dim>>(v.number("rate"));
}

}  // namespace

LoadRow damping_load()
{
  return {.keyword = "damping",
          .help = "a force against every velocity, to come to rest: v falls as exp(-rate t)",
          .parameters = {{.key = "rate",
                          .help = "of the decay of velocities",
                          .quantity = Quantity::rate,
                          .bound = at_least(0),
                          .example = 1e3}},
          .in_plane = make<2>,
          .in_space = make<3>};
}

}  // namespace mpm
