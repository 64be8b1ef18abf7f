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
  const auto add = [&](const IndexVec<Dim>& location, int body, double stiffness,
                       LocalIndex particle) {
    const CellNodes& corners = cells[number++];
    // What is apart is not behind a face.
    const auto is_taken = [&](IndexVec<Dim> at) {
      for (int d = 0; d < Dim; ++d)
        if (period[d] > 0) at[d] = (at[d] + period[d]) % period[d];
      const int other = occupant_of(at).body;
      return other >= 0 && !setup_.pairs.are_apart(body, other);
    };
    if (!near_surface<Dim>(location, is_taken)) return;
    CellNodes nodes;
    for (std::size_t k = 0; k < nodes.size(); ++k) nodes[k] = corners[CellOverlaps<Dim>::order[k]];
    near.push_back({nodes, location, stiffness, {location, is_taken}, body, particle});
  };
  int b = 0;
  for (const Body<Dim>& body : setup_.bodies) {
    const double wave = body.law->wave_speed();
    const double stiffness =
        setup_.contact_stiffness * body.density * wave * wave * setup_.thickness;
    for (LocalIndex p = 0; p < body.particles.size(); ++p)
      add(location_of(body, p), b, stiffness, p);
    ++b;
  }
  for (const RigidCells<Dim>& rigid : setup_.rigid) {
    for (const IndexVec<Dim>& location : rigid.locations) add(location, b, 0, -1);
    ++b;
  }
  contact_ = std::make_unique<OverlapContact<Dim>>(decomposition_.comm(), std::move(near),
                                                   setup_.contact_stiffness, setup_.pairs,
                                                   setup_.location_size, period);
}

template void TotalLagrangian<2>::make_contact(const std::vector<CellNodes>&, const OccupantOf<2>&);
template void TotalLagrangian<3>::make_contact(const std::vector<CellNodes>&, const OccupantOf<3>&);

}  // namespace mpm
