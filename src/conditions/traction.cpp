#include <mpm/conditions/smooth_start.hpp>
#include <mpm/core/side.hpp>

#include <algorithm>
#include <limits>

#include "load_parameters.hpp"

namespace mpm {

namespace {

/// A dead load: a stress vector on the area that the marked particles have in the reference
/// configuration, in a direction that stays.
template <int Dim>
class Traction final : public Load<Dim> {
 public:
  Traction(const Vec<Dim>& stress, double ramp_time, SurfaceMark<Dim> mark)
      : stress_(stress), ramp_time_(ramp_time), mark_(std::move(mark))
  {
  }

  bool acts_on_particles() const override { return true; }
  std::optional<SurfaceMark<Dim>> mark() const override { return mark_; }
  void add_to_particles(const Body<Dim>& body, LocalIndex block, double time,
                        Lanes (&force)[Dim]) const override
  {
    const ColumnGroup& motion = body.particles.motion();
    const Lanes area = smooth_start(1.0, time, ramp_time_) *
                       load(motion.block(block) + motion.find(mark_.column()) * lane_count);
    for (int d = 0; d < Dim; ++d) force[d] += area * stress_[d];
  }

 private:
  Vec<Dim> stress_;
  double ramp_time_;
  SurfaceMark<Dim> mark_;
};

Side side_of(const ParameterValues& v)
{
  return Side(std::ranges::find(side_words, v.word("side")) - side_words.begin());
}

template <int Dim>
std::unique_ptr<Load<Dim>> make(const ParameterValues& v, int number)
{
  const Side side = side_of(v);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  SurfaceMark<Dim> mark{number,
                        axis_of(side),
                        upper_of(side),
                        {Vec<Dim>::Constant(-infinity), Vec<Dim>::Constant(infinity)}};
  if (const Corners& within = v.corners("within"); !within.empty())
    for (int d = 0; d < Dim; ++d) {
      mark.within.lower[d] = within.lower[std::size_t(d)];
      mark.within.upper[d] = within.upper[std::size_t(d)];
    }
  return std::make_unique<Traction<Dim>>(vector_of<Dim>(v, "stress"), v.number("ramp_time"), mark);
}

std::optional<Contradiction> check(const ParameterValues& v, int dimensions)
{
  if (axis_of(side_of(v)) < dimensions) return std::nullopt;
  return Contradiction{"side", "the scene lies in the plane"};
}

}  // namespace

LoadRow traction_load()
{
  return {.keyword = "traction",
          .help =
              "a stress vector on the surface seen from a side, per area of the specimen as "
              "it was at the start",
          .parameters = {{.key = "side",
                          .help = "from which the outermost particle of every row is loaded",
                          .choices = {side_words.begin(), side_words.end()},
                          .required = true},
                         {.key = "stress",
                          .help = "force per area [x, y], in space [x, y, z]",
                          .type = ParameterType::vector,
                          .quantity = Quantity::pressure,
                          .example = 1e6},
                         {.key = "within",
                          .help = "only those of them that lie in this box at the start",
                          .type = ParameterType::box,
                          .fallback = Corners{}},
                         ramp_time_parameter()},
          .in_plane = make<2>,
          .in_space = make<3>,
          .check = check};
}

}  // namespace mpm
