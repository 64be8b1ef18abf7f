#include <mpm/simulation/surface_marks.hpp>
#include <mpm/transfer/scheme.hpp>

#include <algorithm>
#include <cmath>

namespace mpm {

namespace {

/// The particles of a specimen as a load on a surface sees them: in rows along an axis.
template <int Dim>
class Rows {
 public:
  Rows(const SurfaceMark<Dim>& mark, const IndexVec<Dim>& locations, const Layout<Dim>& layout)
      : mark_(mark), locations_(locations), layout_(layout)
  {
  }

  std::size_t count() const
  {
    std::size_t rows = 1;
    for (int d = 0; d < Dim; ++d)
      if (d != mark_.axis) rows *= std::size_t(locations_[d]);
    return rows;
  }

  /// visit(particle, number of its row, how far towards the looker it is) for the specimen's
  /// particles: a load cell stands outside its box.
  template <class Visit>
  void for_each(const ColumnGroup& motion, LocalIndex particles, Visit visit) const
  {
    for (LocalIndex p = 0; p < particles; ++p) {
      const IndexVec<Dim> at = location(motion, p);
      const LocalIndex last = locations_[mark_.axis] - 1;
      if (at[mark_.axis] < 0 || at[mark_.axis] > last) continue;
      std::size_t row = 0;
      for (int d = Dim; d-- > 0;)
        if (d != mark_.axis) row = row * std::size_t(locations_[d]) + std::size_t(at[d]);
      visit(p, row, mark_.upper ? at[mark_.axis] : last - at[mark_.axis]);
    }
  }

 private:
  IndexVec<Dim> location(const ColumnGroup& motion, LocalIndex p) const
  {
    IndexVec<Dim> at;
    for (int d = 0; d < Dim; ++d)
      at[d] = LocalIndex(
          std::floor(motion(LeadingColumns<Dim>::position + d, p) / layout_.location_size[d]));
    return at;
  }

  const SurfaceMark<Dim>& mark_;
  const IndexVec<Dim>& locations_;
  const Layout<Dim>& layout_;
};

template <int Dim>
Vec<Dim> position_of(const ColumnGroup& motion, LocalIndex p)
{
  Vec<Dim> position;
  for (int d = 0; d < Dim; ++d) position[d] = motion(LeadingColumns<Dim>::position + d, p);
  return position;
}

}  // namespace

template <int Dim>
std::vector<GlobalIndex> mark_surfaces(MPI_Comm comm, std::span<const SurfaceMark<Dim>> marks,
                                       const IndexVec<Dim>& locations, const Layout<Dim>& layout,
                                       std::vector<Body<Dim>>& bodies)
{
  std::vector<GlobalIndex> counts(marks.size(), 0);
  for (std::size_t k = 0; k < marks.size(); ++k) {
    const SurfaceMark<Dim>& mark = marks[k];
    const Rows<Dim> rows(mark, locations, layout);
    // Who is the outermost of a row may be known to another rank only. Every rank holds a number
    // per row: as many as the face has locations.
    std::vector<double> outermost(rows.count(), -1);
    for (const Body<Dim>& body : bodies)
      rows.for_each(body.particles.motion(), body.particles.size(),
                    [&](LocalIndex, std::size_t row, LocalIndex towards) {
                      outermost[row] = std::max(outermost[row], double(towards));
                    });
    largest_over_ranks(comm, outermost);

    const double area = layout.particle_volume / layout.location_size[mark.axis];
    for (Body<Dim>& body : bodies) {
      ColumnGroup& motion = body.particles.motion();
      const int column = motion.find(mark.column());
      rows.for_each(motion, body.particles.size(),
                    [&](LocalIndex p, std::size_t row, LocalIndex towards) {
                      if (towards != outermost[row]) return;
                      if (!mark.within.contains(position_of<Dim>(motion, p))) return;
                      motion(column, p) = area;
                      ++counts[k];
                    });
    }
  }
  sum_over_ranks(comm, counts);
  return counts;
}

template std::vector<GlobalIndex> mark_surfaces(MPI_Comm, std::span<const SurfaceMark<2>>,
                                                const IndexVec<2>&, const Layout<2>&,
                                                std::vector<Body<2>>&);
template std::vector<GlobalIndex> mark_surfaces(MPI_Comm, std::span<const SurfaceMark<3>>,
                                                const IndexVec<3>&, const Layout<3>&,
                                                std::vector<Body<3>>&);

}  // namespace mpm
