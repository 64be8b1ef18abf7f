/// Which cells meet others in contact.

#include <mpm/core/error.hpp>
#include <mpm/lagrangian/overlap_contact.hpp>
#include <mpm/lagrangian/total_lagrangian.hpp>

namespace mpm {

template <>
void TotalLagrangian<2>::make_contact(const std::vector<CellNodes>& cells,
                                      const std::function<int(const IndexVec<2>&)>& rank_of)
{
  const IndexVec<2> period = this->period();
  const auto is_taken = [&](IndexVec<2> location) {
    for (int d = 0; d < 2; ++d)
      if (period[d] > 0) location[d] = (location[d] + period[d]) % period[d];
    return rank_of(location) >= 0;
  };
  /// Bit k: nothing on one side at least of the diagonal neighbour towards corner k.
  const auto open_corners = [&](const IndexVec<2>& location) {
    unsigned open = 0;
    for (int corner = 0; corner < 4; ++corner)
      if (!is_taken(location + IndexVec<2>(corner & 1 ? 1 : -1, 0)) ||
          !is_taken(location + IndexVec<2>(0, corner & 2 ? 1 : -1)))
        open |= 1u << corner;
    return open;
  };
  std::vector<OverlapContact::Cell> near;
  std::size_t number = 0;
  for (int b = 0; b < int(setup_.bodies.size()); ++b) {
    const Body<2>& body = setup_.bodies[std::size_t(b)];
    const double wave = body.law->wave_speed();
    const double stiffness =
        setup_.contact_stiffness * body.density * wave * wave * setup_.thickness;
    for (LocalIndex p = 0; p < body.particles.size(); ++p, ++number) {
      const IndexVec<2> location = location_of(body, p);
      if (!near_surface<2>(location, is_taken)) continue;
      const auto& n = cells[number];
      near.push_back({{n[0], n[1], n[3], n[2]}, location, stiffness, open_corners(location), b, p});
    }
  }
  contact_ =
      std::make_unique<OverlapContact>(decomposition_.comm(), std::move(near),
                                       setup_.contact_stiffness, setup_.location_size, period);
}

template <>
void TotalLagrangian<3>::make_contact(const std::vector<CellNodes>&,
                                      const std::function<int(const IndexVec<3>&)>&)
{
  throw InputError("cells meet each other in the plane only: in space contact_stiffness is 0");
}

}  // namespace mpm
