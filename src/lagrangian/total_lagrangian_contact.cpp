/// Which cells meet others in contact.

#include <mpm/lagrangian/cell_overlaps.hpp>
#include <mpm/lagrangian/total_lagrangian.hpp>

namespace mpm {

/// Its outline and its volume. `nodes`: in the order of CellOverlaps.
template <int Dim>
auto TotalLagrangian<Dim>::form_of(const CellNodes& nodes) const -> CellForm
{
  CellForm form;
  CornerPlaces<Dim> rest;
  for (std::size_t k = 0; k < nodes.size(); ++k)
    for (int d = 0; d < Dim; ++d) rest[k][d] = nodes_->rest(nodes[k], d);
  if constexpr (Dim == 2)
    if (!setup_.offsets.empty()) {
      CornerPlaces<2> ways;
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        const IndexVec<2>& corner = nodes_->corner(nodes[k]);
        rest[k] += setup_.offsets(corner);
        ways[k] = setup_.offsets.way(corner);
      }
      form.outline = CellOutline::at(rest, ways);
      if (form.outline) form.outline->take_corners(rest);
    }
  double values[CellOverlaps<Dim>::values];
  CellOverlaps<Dim>::describe(rest, values);
  form.volume = CellOverlaps<Dim>::volume(values);
  return form;
}

template <int Dim>
auto TotalLagrangian<Dim>::contact_cells(const Occupants<Dim>& occupants) const -> ContactCells
{
  const IndexVec<Dim> period = this->period();
  ContactCells near;
  const auto add = [&](const CellNodes& corners, int body, double stiffness, LocalIndex particle) {
    const IndexVec<Dim> location = nodes_->corner(corners[0]);
    // What is apart is not behind a face.
    const auto is_taken = [&](IndexVec<Dim> at) {
      for (int d = 0; d < Dim; ++d)
        if (period[d] > 0) at[d] = (at[d] + period[d]) % period[d];
      const int other = occupants(at).body;
      return other >= 0 && !setup_.pairs.are_apart(body, other);
    };
    if (!near_surface<Dim>(location, is_taken)) return;
    CellNodes nodes;
    for (std::size_t k = 0; k < nodes.size(); ++k) nodes[k] = corners[CellOverlaps<Dim>::order[k]];
    const CellForm form = form_of(nodes);
    near.cells.push_back(
        {nodes, location, stiffness, form.volume, {location, is_taken}, body, particle});
    if (form.outline) {
      near.cells.back().outline = LocalIndex(near.outlines.size());
      near.outlines.push_back(*form.outline);
    }
  };
  int b = 0;
  for (const Body<Dim>& body : setup_.bodies) {
    const double wave = body.law->wave_speed();
    const double stiffness =
        setup_.contact_stiffness * body.density * wave * wave * setup_.thickness;
    for (LocalIndex p = 0; p < body.particles.size(); ++p)
      add(cells_[std::size_t(b)].nodes_of(p), b, stiffness, p);
    ++b;
  }
  auto rigid_cell = rigid_cells_.begin();
  for (const RigidCells<Dim>& rigid : setup_.rigid) {
    for (std::size_t k = 0; k < rigid.locations.size(); ++k) add(*rigid_cell++, b, 0, -1);
    ++b;
  }
  return near;
}

template auto TotalLagrangian<2>::contact_cells(const Occupants<2>&) const -> ContactCells;
template auto TotalLagrangian<3>::contact_cells(const Occupants<3>&) const -> ContactCells;

}  // namespace mpm
