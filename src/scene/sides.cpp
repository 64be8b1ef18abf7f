#include <mpm/scene/sides.hpp>

namespace mpm::scene {

std::optional<Lateral> side_of(const Scene& scene, int axis, bool upper)
{
  const auto* loading = std::get_if<Loading>(&scene.motion);
  if (!loading) return std::get<FreeMotion>(scene.motion).sides[std::size_t(2 * axis + upper)];
  const int piston = axis_of(loading->piston);
  if (axis == piston) return std::nullopt;
  return loading->lateral[std::size_t(2 * (axis - (axis > piston)) + upper)];
}

bool is_periodic(const Scene& scene, int axis)
{
  const std::optional<Lateral> side = side_of(scene, axis, false);
  return side && (*side)->periodic;
}

}  // namespace mpm::scene
