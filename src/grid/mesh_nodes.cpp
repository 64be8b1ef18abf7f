#include <mpm/grid/mesh_nodes.hpp>

#include <algorithm>
#include <cmath>

namespace mpm {

template <int Dim>
MeshNodes<Dim>::MeshNodes(std::vector<IndexVec<Dim>> corners, std::vector<char> owned,
                          const Vec<Dim>& size, const IndexVec<Dim>& period,
                          const CornerOffsets<Dim>& offsets)
    : corners_(std::move(corners)),
      owned_(std::move(owned)),
      location_size_(size),
      period_(period),
      listing_(Nodes<Dim>::new_listing())
{
  places_.assign(owned_.size() * std::size_t(stride == 1 ? Dim : stride), 0.0);
  for (LocalIndex node = 0; node < this->size(); ++node) {
    const Vec<Dim> offset = offsets(corner(node));
    for (int d = 0; d < Dim; ++d) place(node, d) = rest(node, d) + offset[d];
  }
}

template <int Dim>
void MeshNodes<Dim>::lead(LocalIndex node)
{
  led_.resize(owned_.size(), 0);
  led_[std::size_t(node)] = 1;
}

template <int Dim>
Vec<Dim> MeshNodes<Dim>::position(LocalIndex node) const
{
  Vec<Dim> position;
  for (int d = 0; d < Dim; ++d) position[d] = along(d)[std::ptrdiff_t(node) * stride];
  return position;
}

template <int Dim>
Vec<Dim> MeshNodes<Dim>::period() const
{
  return period_.template cast<double>().cwiseProduct(location_size_);
}

template <int Dim>
void MeshNodes<Dim>::find_within(const Region<Dim>& region, std::vector<LocalIndex>& nodes) const
{
  nodes.clear();
  for (LocalIndex node = 0; node < size(); ++node)
    if (region.contains(position(node))) nodes.push_back(node);
}

template <int Dim>
double MeshNodes<Dim>::move(NodeFields<Dim>& fields, double dt)
{
  // Nodes whose records stay in the nearest cache while all is done with them.
  constexpr LocalIndex piece = 128;
  double fastest = 0;
  for (LocalIndex first = 0; first < size(); first += piece) {
    const NodeRun<Dim> some{first, std::min(piece, size() - first), IndexVec<Dim>::Zero()};
    fields.carry_momentum(std::span(&some, 1));
    for (LocalIndex node = first; node < first + some.length; ++node) {
      const double* u = fields.updated_of(node);
      for (int d = 0; d < Dim; ++d) {
        place(node, d) += dt * u[d];
        fastest = std::max(fastest, std::abs(u[d]));
      }
      std::fill_n(fields.force_of(node), Dim, 0.0);
    }
  }
  way_ += dt * fastest;
  listing_ = Nodes<Dim>::new_listing();
  if (free_.empty()) return fastest;
  fastest = 0;
  for (LocalIndex node = 0; node < size(); ++node)
    for (int d = 0; d < Dim && !is_free(node); ++d)
      fastest = std::max(fastest, std::abs(fields.updated_of(node)[d]));
  return fastest;
}

template <int Dim>
void MeshNodes<Dim>::archive(Archive& archive)
{
  archive.values("places", places_);
  archive.value("way", way_);
  if (archive.is_loading()) listing_ = Nodes<Dim>::new_listing();
}

template <int Dim>
std::size_t MeshNodes<Dim>::bytes() const
{
  return owned_.size() * (sizeof(char) + sizeof(IndexVec<Dim>)) +
         (led_.size() + free_.size()) * sizeof(char) + places_.size() * sizeof(double);
}

template class MeshNodes<2>;
template class MeshNodes<3>;

}  // namespace mpm
