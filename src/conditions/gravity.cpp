#include <mpm/conditions/smooth_start.hpp>

#include "load_parameters.hpp"

namespace mpm {

namespace {

/// The same acceleration everywhere: f_i = m_i g.
template <int Dim>
class Gravity final : public Load<Dim> {
 public:
  Gravity(const Vec<Dim>& acceleration, double ramp_time)
      : acceleration_(acceleration), ramp_time_(ramp_time)
  {
  }

  bool acts_on_particles() const override { return false; }
  void add_to_nodes(const Nodes<Dim>&, std::span<const NodeRun<Dim>> runs, NodeFields<Dim>& fields,
                    double time, double) const override
  {
    const Vec<Dim> g = smooth_start(1.0, time, ramp_time_) * acceleration_;
    for (const NodeRun<Dim>& run : runs)
      for (LocalIndex node = run.first; node < run.first + run.length; ++node)
        for (int d = 0; d < Dim; ++d)
          fields.load_force[std::size_t(node) * Dim + d] += fields.loaded_mass_of(node) * g[d];
  }

 private:
  Vec<Dim> acceleration_;
  double ramp_time_;
};

template <int Dim>
std::unique_ptr<Load<Dim>> make(const ParameterValues& v, int)
{
  return std::make_unique<Gravity<Dim>>(vector_of<Dim>(v, "acceleration"), v.number("ramp_time"));
}

}  // namespace

LoadRow gravity_load()
{
  return {.keyword = "gravity",
          .help = "the same acceleration everywhere",
          .parameters = {{.key = "acceleration",
                          .help = "vector [x, y], in space [x, y, z]",
                          .type = ParameterType::vector,
                          .quantity = Quantity::acceleration,
                          .example = -9.81},
                         ramp_time_parameter()},
          .in_plane = make<2>,
          .in_space = make<3>};
}

}  // namespace mpm
