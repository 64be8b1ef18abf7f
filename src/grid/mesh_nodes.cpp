#include <mpm/core/error.hpp>
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
      mesh_(Nodes<Dim>::new_listing()),
      listing_(mesh_)
{
  places_.assign(owned_.size() * place_width, 0.0);
  for (LocalIndex node = 0; node < this->size(); ++node) {
    const Vec<Dim> offset = offsets(corner(node));
    for (int d = 0; d < Dim; ++d) place(node, d) = rest(node, d) + offset[d];
  }
}

template <int Dim>
Vec<Dim> MeshNodes<Dim>::position(LocalIndex node) const
{
  return Eigen::Map<const Vec<Dim>>(place_of(node));
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

/// Of a node of that node's kind at a corner.
template <int Dim>
GlobalIndex MeshNodes<Dim>::key(LocalIndex node, const IndexVec<Dim>& corner) const
{
  constexpr int bits = 56 / Dim;  // which leaves seven for the kind
  GlobalIndex key = kinds_.empty() ? 0 : kinds_[std::size_t(node)];
  // Corners of a load cell lie below 0.
  constexpr GlobalIndex lower_bits = (GlobalIndex(1) << bits) - 1;
  for (int d = Dim - 1; d >= 0; --d) key = key << bits | (GlobalIndex(corner[d]) & lower_bits);
  return key;
}

/// Of each node, where it stands among all ranks', which all ask; `saved`: the corner that it has
/// there, as a node where an axis begins again may have been another image.
template <int Dim>
std::vector<std::int64_t> MeshNodes<Dim>::find_saved(Archive& archive,
                                                     std::vector<IndexVec<Dim>>& saved) const
{
  saved = corners_;
  std::vector<std::int64_t> keys;
  for (LocalIndex node = 0; node < size(); ++node) keys.push_back(key(node, corner(node)));
  std::vector<std::int64_t> rows = archive.places_of("key", keys);
  for (int images = 1; images < 1 << Dim; ++images) {
    bool are_there = true;
    for (int d = 0; d < Dim; ++d) are_there = are_there && (!(images >> d & 1) || period_[d] > 0);
    if (!are_there) continue;
    std::vector<LocalIndex> astray;
    std::vector<IndexVec<Dim>> at;
    std::vector<std::int64_t> image_keys;
    for (LocalIndex node = 0; node < size(); ++node) {
      if (rows[std::size_t(node)] >= 0) continue;
      IndexVec<Dim> image = corner(node);
      for (int d = 0; d < Dim; ++d)
        if (images >> d & 1 && image[d] % period_[d] == 0) image[d] = period_[d] - image[d];
      astray.push_back(node);
      at.push_back(image);
      image_keys.push_back(key(node, image));
    }
    const std::vector<std::int64_t> found = archive.places_of("key", image_keys);
    for (std::size_t k = 0; k < astray.size(); ++k) {
      rows[std::size_t(astray[k])] = found[k];
      saved[std::size_t(astray[k])] = at[k];
    }
  }
  if (std::ranges::find(rows, -1) != rows.end())
    throw InputError(
        "saved state: nodes of this mesh are not there. Go on with the scene that it is of.");
  return rows;
}

template <int Dim>
std::vector<std::int64_t> MeshNodes<Dim>::archive(Archive& archive)
{
  std::vector<IndexVec<Dim>> saved;
  std::vector<std::int64_t> rows, keys;
  if (archive.regroups()) {
    rows = find_saved(archive, saved);
  } else {
    for (LocalIndex node = 0; node < size(); ++node) keys.push_back(key(node, corner(node)));
    archive.values("key", keys);
  }
  std::vector<double> places;
  for (LocalIndex node = 0; node < size(); ++node)
    for (int d = 0; d < Dim; ++d) places.push_back(place(node, d));
  archive.rows("places", rows, places);
  archive.value("way", way_, Over::largest);
  if (!archive.is_loading()) return rows;
  for (LocalIndex node = 0; node < size(); ++node)
    for (int d = 0; d < Dim; ++d) {
      double& here = place(node, d);
      here = places[std::size_t(node * Dim + d)];
      if (!saved.empty()) here += (corner(node) - saved[std::size_t(node)])[d] * location_size_[d];
    }
  listing_ = Nodes<Dim>::new_listing();
  return rows;
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
