#include <mpm/grid/grid_geometry.hpp>

#include <cmath>

namespace mpm {

template <int Dim>
IndexVec<Dim> GridGeometry<Dim>::cell_of(const Vec<Dim>& position) const
{
  IndexVec<Dim> cell;
  for (int d = 0; d < Dim; ++d)
    cell[d] = LocalIndex(std::floor((position[d] - origin[d]) * (1.0 / spacing[d])));
  return cell;
}

template <int Dim>
IndexVec<Dim> GridGeometry<Dim>::periods_of(const IndexVec<Dim>& index) const
{
  IndexVec<Dim> periods = IndexVec<Dim>::Zero();
  for (int d = 0; d < Dim; ++d)
    if (periodic[d])  // rounded down, also below 0
      periods[d] = index[d] >= 0 ? index[d] / nodes[d] : -((nodes[d] - 1 - index[d]) / nodes[d]);
  return periods;
}

template struct GridGeometry<2>;
template struct GridGeometry<3>;

}  // namespace mpm
