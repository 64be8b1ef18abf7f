#include <mpm/conditions/smooth_start.hpp>
#include <mpm/transfer/scheme.hpp>

#include <algorithm>
#include <array>

#include "load_parameters.hpp"

namespace mpm {

namespace {

/// An acceleration that depends on place and time, taken where the particles are now.
template <int Dim>
class BodyForce final : public Load<Dim> {
  using Columns = LeadingColumns<Dim>;

 public:
  BodyForce(Formulas acceleration, double ramp_time)
      : acceleration_(std::move(acceleration)),
        ramp_time_(ramp_time),
        needs_initial_position_(std::ranges::any_of(acceleration_, &Formula::uses_initial_place))
  {
  }

  bool acts_on_particles() const override { return true; }
  bool needs_initial_position() const override { return needs_initial_position_; }
  void add_to_particles(const Body<Dim>& body, LocalIndex block, double time,
                        Lanes (&force)[Dim]) const override
  {
    const ColumnGroup& group = body.particles.motion();
    const double* motion = group.block(block);
    const int initial =
        needs_initial_position_ ? group.find("initial_position") : Columns::position;
    std::array<double, Dim> place, initial_place;
    alignas(lane_alignment) double acceleration[Dim][lane_count];
    for (int lane = 0; lane < lane_count; ++lane) {
      for (int d = 0; d < Dim; ++d) {
        place[std::size_t(d)] = motion[(Columns::position + d) * lane_count + lane];
        initial_place[std::size_t(d)] = motion[(initial + d) * lane_count + lane];
      }
      for (int d = 0; d < Dim; ++d)
        acceleration[d][lane] = acceleration_[std::size_t(d)](place, initial_place, time);
    }
    const Lanes mass =
        smooth_start(1.0, time, ramp_time_) * load(motion + Columns::mass * lane_count);
    for (int d = 0; d < Dim; ++d) force[d] += mass * load(acceleration[d]);
  }

 private:
  Formulas acceleration_;
  double ramp_time_;
  bool needs_initial_position_;
};

template <int Dim>
std::unique_ptr<Load<Dim>> make(const ParameterValues& v, int)
{
  return std::make_unique<BodyForce<Dim>>(v.formulas("acceleration"), v.number("ramp_time"));
}

}  // namespace

LoadRow body_force_load()
{
  return {
      .keyword = "body_force",
      .help = "an acceleration that depends on place and time",
      .parameters =
          {{.key = "acceleration",
            .help =
                "formulas of t, of x, y (z) where a particle is and of X, Y (Z) where it was at "
                "t = 0, m/s^2",
            .type = ParameterType::formulas,
            .quantity = Quantity::acceleration},
           ramp_time_parameter()},
      .in_plane = make<2>,
      .in_space = make<3>};
}

}  // namespace mpm
