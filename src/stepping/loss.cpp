#include <mpm/core/error.hpp>
#include <mpm/materials/present_deformation.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/stepping/loss.hpp>

#include <cmath>

#include <fmt/format.h>

namespace mpm {

namespace {

template <int Dim>
std::string text_of(const Vec<Dim>& v, int digits)
{
  std::string text;
  for (int d = 0; d < Dim; ++d) text += fmt::format("{}{:.{}g}", d ? ", " : "", v[d], digits);
  return text;
}

template <int Dim>
std::string words_for(const Loss<Dim>& loss, const GridGeometry<Dim>& geometry)
{
  const LostParticle<Dim>& lost = loss.particle;
  const auto tell = [&](const std::string& what, const char* remedy) {
    return fmt::format(
        "particle {} of body '{}' {} at ({}) m in step {}, t = {:.6g} s, with velocity ({}) m/s. "
        "{}",
        lost.id, loss.body, what, text_of<Dim>(lost.position, 6), loss.moment.step,
        loss.moment.time, text_of<Dim>(lost.velocity, 4), remedy);
  };
  if (lost.fault == Fault::inverted && std::isfinite(lost.ratio))
    return tell(fmt::format("was turned inside out, det(I + dt L) = {:.3g},", lost.ratio),
                "Lower numerics.cfl.");
  if (lost.fault == Fault::beyond_bounds && std::isfinite(lost.ratio))
    return tell(fmt::format("has {:.3g} times its first volume, bounds are {} and {},", lost.ratio,
                            least_volume_ratio, largest_volume_ratio),
                "Lower numerics.cfl, or give it a stiffer material.");
  bool outside = false, finite = std::isfinite(lost.ratio);
  for (int d = 0; d < Dim; ++d) {
    finite = finite && std::isfinite(lost.position[d]) && std::isfinite(lost.velocity[d]);
    if (geometry.periodic[d]) continue;
    outside = outside || lost.position[d] < geometry.node_position(d, 1) ||
              lost.position[d] >= geometry.node_position(d, geometry.nodes[d] - 2);
  }
  const char* what = !finite   ? "is no longer a number"
                     : outside ? "left the grid"
                               : "moved by more than a cell in one step";
  const char* remedy = !finite || !outside
                           ? "Lower numerics.cfl."
                           : "Give the grid a wider grid.margin, or lower numerics.cfl.";
  return tell(what, remedy);
}

}  // namespace

template <int Dim>
void stop_at(GlobalIndex first, const std::optional<Loss<Dim>>& loss, MPI_Comm comm,
             const GridGeometry<Dim>& geometry)
{
  agree(comm, [&] {
    if (loss && loss->moment.step == first)
      throw NumericalError(words_for<Dim>(*loss, geometry), loss->particle.id);
  });
  throw NumericalError("a rank stopped without a reason");  // agree() has thrown before
}

template void stop_at(GlobalIndex, const std::optional<Loss<2>>&, MPI_Comm, const GridGeometry<2>&);
template void stop_at(GlobalIndex, const std::optional<Loss<3>>&, MPI_Comm, const GridGeometry<3>&);

}  // namespace mpm
