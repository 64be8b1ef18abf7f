/// Which cells meet others in contact.

#include <mpm/lagrangian/cell_overlaps.hpp>
#include <mpm/lagrangian/total_lagrangian.hpp>

namespace mpm {

template <int Dim>
auto TotalLagrangian<Dim>::contact_cells(const Occupants<Dim>& occupants) const
    -> std::vector<ContactCell>
{
  const IndexVec<Dim> period = this->period();
  std::vector<ContactCell> near;
  for (int b = 0; b < int(setup_.bodies.size()); ++b) {
    // What is apart is not behind a face.
    const auto is_taken = [&](IndexVec<Dim> location) {
      for (int d = 0; d < Dim; ++d)
        if (period[d] > 0) location[d] = (location[d] + period[d]) % period[d];
      const int other = occupants(location).body;
      return other >= 0 && !setup_.pairs.are_apart(b, other);
    };
    const Body<Dim>& body = setup_.bodies[std::size_t(b)];
    const double wave = body.law->wave_speed();
    const double stiffness =
        setup_.contact_stiffness * body.density * wave * wave * setup_.thickness;
    for (LocalIndex p = 0; p < body.particles.size(); ++p) {
      const CellNodes corners = cells_[std::size_t(b)].nodes_of(p);
      const IndexVec<Dim> location = nodes_->corner(corners[0]);
      if (!near_surface<Dim>(location, is_taken)) continue;
      CellNodes nodes;
      for (std::size_t k = 0; k < nodes.size(); ++k)
        nodes[k] = corners[CellOverlaps<Dim>::order[k]];
      near.push_back({nodes, location, stiffness, {location, is_taken}, b, p});
    }
  }
  return near;
}

template auto TotalLagrangian<2>::contact_cells(const Occupants<2>&) const
    -> std::vector<ContactCell>;
template auto TotalLagrangian<3>::contact_cells(const Occupants<3>&) const
    -> std::vector<ContactCell>;

}  // namespace mpm
