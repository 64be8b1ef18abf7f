#include <mpm/conditions/rigid_body.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/simulation/method.hpp>
#include <mpm/simulation/rigid_bodies.hpp>

namespace mpm {

namespace {

using micrograph::Lattice;
using micrograph::Specimen;

/// Of all ranks, each of which looks at its slab. Collective.
template <int Dim>
std::vector<Vec<Dim>> points_of(int material, const Specimen<Dim>& specimen,
                                const Layout<Dim>& layout, MPI_Comm comm)
{
  const IndexBox<Dim> own = micrograph::slab(specimen.whole(), rank_of(comm), ranks_of(comm));
  const Lattice<Dim> lattice = specimen.lattice(own);
  std::vector<double> coordinates;
  std::size_t place = 0;
  for_each_index(own, [&](const IndexVec<Dim>& at) {
    if (lattice.material[place++] != material) return;
    for (int d = 0; d < Dim; ++d) coordinates.push_back((at[d] + 0.5) * layout.location_size[d]);
  });
  const std::vector<double> all = joined_over_ranks(comm, coordinates);
  std::vector<Vec<Dim>> points(all.size() / Dim);
  for (std::size_t k = 0; k < points.size(); ++k)
    for (int d = 0; d < Dim; ++d) points[k][d] = all[k * Dim + d];
  return points;
}

}  // namespace

template <int Dim>
void add_rigid_body(const scene::Scene& scene, int material, const Specimen<Dim>& specimen,
                    const Layout<Dim>& layout, const Decomposition<Dim>& decomposition,
                    Model<Dim>& model)
{
  const scene::Material& rigid = scene.materials[std::size_t(material)];
  const auto motion = motion_of<Dim>(rigid);
  if (!is_total_lagrangian(scene.numerics)) {
    model.slots.conditions.push_back(std::make_unique<RigidBody<Dim>>(
        points_of(material, specimen, layout, decomposition.comm()), 0.5 * layout.location_size,
        motion, reaction_book(scene.numerics)));
    return;
  }
  RigidCells<Dim>& cells = model.rigid.emplace_back(RigidCells<Dim>{rigid.name, {}, motion});
  const Lattice<Dim> lattice = specimen.lattice(nearby(specimen.whole(), layout, decomposition));
  for_each_index(lattice.part, [&](const IndexVec<Dim>& at) {
    if (lattice(at) == material &&
        decomposition.owner_of_cell(layout.cell_of_location(at)) == decomposition.rank())
      cells.locations.push_back(at);
  });
}

template void add_rigid_body(const scene::Scene&, int, const Specimen<2>&, const Layout<2>&,
                             const Decomposition<2>&, Model<2>&);
template void add_rigid_body(const scene::Scene&, int, const Specimen<3>&, const Layout<3>&,
                             const Decomposition<3>&, Model<3>&);

}  // namespace mpm
