/// Which cells meet others in contact.

#include <mpm/lagrangian/overlap_contact.hpp>
#include <mpm/lagrangian/total_lagrangian.hpp>

namespace mpm {

template <int Dim>
void TotalLagrangian<Dim>::make_contact(const std::vector<CellNodes>& cells,
                                        const OccupantOf<Dim>& occupant_of)
{
  const IndexVec<Dim> period = this->period();
  std::vector<typename OverlapContact<Dim>::Cell> near;
  std::size_t number = 0;
  for (int b = 0; b < int(setup_.bodies.size()); ++b) {
    // What is apart is not behind a face.
    const auto is_taken = [&](IndexVec<Dim> location) {
      for (int d = 0; d < Dim; ++d)
        if (period[d] > 0) location[d] = (location[d] + period[d]) % period[d];
      const int other = occupant_of(location).body;
      return other >= 0 && !setup_.pairs.are_apart(b, other);
    };
    const Body<Dim>& body = setup_.bodies[std::size_t(b)];
    const double wave = body.law->wave_speed();
    const double stiffness =
        setup_.contact_stiffness * body.density * wave * wave * setup_.thickness;
    for (LocalIndex p = 0; p < body.particles.size(); ++p, ++number) {
      const IndexVec<Dim> location = location_of(body, p);
      if (!near_surface<Dim>(location, is_taken)) continue;
      CellNodes nodes;
      for (std::size_t k = 0; k < nodes.size(); ++k)
        nodes[k] = cells[number][CellOverlaps<Dim>::order[k]];
      near.push_back({nodes, location, stiffness, {location, is_taken}, b, p});
    }
  }
  contact_ = std::make_unique<OverlapContact<Dim>>(decomposition_.comm(), std::move(near),
                                                   setup_.contact_stiffness, setup_.pairs,
                                                   setup_.location_size, period);
}

template void TotalLagrangian<2>::make_contact(const std::vector<CellNodes>&, const OccupantOf<2>&);
template void TotalLagrangian<3>::make_contact(const std::vector<CellNodes>&, const OccupantOf<3>&);

}  // namespace mpm
