#include <mpm/core/error.hpp>
#include <mpm/grid/node_grid.hpp>

#include <algorithm>
#include <cmath>

namespace mpm {

namespace {

template <int Dim>
std::vector<char> marks_of(const IndexBox<Dim>& local, const IndexBox<Dim>& part)
{
  std::vector<char> marks;
  for_each_index(local, [&](const IndexVec<Dim>& node) { marks.push_back(part.contains(node)); });
  return marks;
}

}  // namespace

template <int Dim>
IndexVec<Dim> GridGeometry<Dim>::cell_of(const Vec<Dim>& position) const
{
  IndexVec<Dim> cell;
  for (int d = 0; d < Dim; ++d)
    cell[d] = LocalIndex(std::floor((position[d] - origin[d]) * (1.0 / spacing[d])));
  return cell;
}

template <int Dim>
NodeGrid<Dim>::NodeGrid(const GridGeometry<Dim>& geometry, const IndexBox<Dim>& local,
                        std::vector<char> owned, double mass_cut)
    : geometry_(geometry), local_(local), mass_cut_(mass_cut), owned_(std::move(owned))
{
  const IndexVec<Dim> count = local.count();
  LocalIndex stride = 1;
  for (int d = 0; d < Dim; ++d) {
    stride_[d] = stride;
    stride *= count[d];
  }
  size_ = stride;
  // Rows of node masses are added four at a time: room for the last row's tail.
  mass.assign(size_ + 4, 0.0);
  momentum_force.assign(std::size_t(size_) * record_width, 0.0);
  updated.assign(std::size_t(size_) * record_width, 0.0);
  remapped_momentum.assign(std::size_t(size_) * remap_width, 0.0);
  gradient_velocity.assign(std::size_t(size_) * velocity_width, 0.0);
  touched_.assign(size_, 0);
  kept_.assign(size_, 0);
  MPM_ASSERT(LocalIndex(owned_.size()) == size_);
}

template <int Dim>
NodeGrid<Dim>::NodeGrid(const GridGeometry<Dim>& geometry, const IndexBox<Dim>& local,
                        const IndexBox<Dim>& owned, double mass_cut)
    : NodeGrid(geometry, local, marks_of(local, owned), mass_cut)
{
}

template <int Dim>
void NodeGrid<Dim>::reset()
{
  for (const NodeRun<Dim>& run : runs_) {
    std::fill_n(mass.begin() + run.first, run.length, 0.0);
    std::fill_n(momentum_force.begin() + std::size_t(run.first) * record_width,
                std::size_t(run.length) * record_width, 0.0);
  }
}

template <int Dim>
void NodeGrid<Dim>::reset_remap()
{
  for (const NodeRun<Dim>& run : runs_)
    std::fill_n(remapped_momentum.begin() + std::size_t(run.first) * remap_width,
                std::size_t(run.length) * remap_width, 0.0);
}

template <int Dim>
void NodeGrid<Dim>::keep_active(const std::vector<LocalIndex>& shared_nodes)
{
  kept_.assign(size_, 0);
  for (const LocalIndex node : shared_nodes) kept_[node] = 1;
  grow<Dim>(kept_, local_.count(), 1, 1);
}

template <int Dim>
void NodeGrid<Dim>::end_activity(int support)
{
  const IndexVec<Dim> count = local_.count();
  // A particle's stencil may move by one node either way before the next call.
  std::vector<char> grown = touched_;
  grow<Dim>(grown, count, 1, support);
  for (LocalIndex node = 0; node < size_; ++node) grown[node] |= kept_[node];
  // What is no longer reached must hold zeros, as nodes outside the runs are never cleared.
  for (const NodeRun<Dim>& run : runs_)
    for (LocalIndex node = run.first; node < run.first + run.length; ++node) {
      if (grown[node]) continue;
      mass[node] = 0;
      std::fill_n(momentum_force.begin() + std::size_t(node) * record_width, record_width, 0.0);
      std::fill_n(updated.begin() + std::size_t(node) * record_width, record_width, 0.0);
      std::fill_n(remapped_momentum.begin() + std::size_t(node) * remap_width, remap_width, 0.0);
      std::fill_n(gradient_velocity.begin() + std::size_t(node) * velocity_width, velocity_width,
                  0.0);
    }
  runs_.clear();
  for (LocalIndex row = 0; row < size_; row += count[0])
    for (LocalIndex i = 0; i < count[0]; ++i) {
      if (!grown[row + i]) continue;
      LocalIndex end = i;
      while (end < count[0] && grown[row + end]) ++end;
      NodeRun<Dim> run{row + i, end - i, local_.lower};
      run.start[0] += i;
      for (int d = 1; d < Dim; ++d) run.start[d] += row / stride_[d] % count[d];
      runs_.push_back(run);
      i = end;
    }
}

template <int Dim>
LocalIndex NodeGrid<Dim>::active_nodes() const
{
  LocalIndex nodes = 0;
  for (const NodeRun<Dim>& run : runs_) nodes += run.length;
  return nodes;
}

template <int Dim>
void NodeGrid<Dim>::update_velocity(double dt)
{
  for (const NodeRun<Dim>& run : runs_)
    for (LocalIndex node = run.first; node < run.first + run.length; ++node) {
      const double inverse_mass = is_active(node) ? 1.0 / mass[node] : 0.0;
      const double* mf = &momentum_force[std::size_t(node) * record_width];
      double* u = &updated[std::size_t(node) * record_width];
      for (int d = 0; d < Dim; ++d) {
        const double increment = dt * mf[Dim + d] * inverse_mass;
        u[d] = mf[d] * inverse_mass + increment;
        u[Dim + d] = increment;
      }
    }
}

template <int Dim>
void NodeGrid<Dim>::set_gradient_velocity(LocalIndex node, int component, double value)
{
  double* v = gradient_velocity_of(node);
  v[component] = value;
  if constexpr (Dim == 2) v[Dim + component] = value;
}

template <int Dim>
void NodeGrid<Dim>::gradient_from_momentum()
{
  for (const NodeRun<Dim>& run : runs_)
    for (LocalIndex node = run.first; node < run.first + run.length; ++node) {
      const double inverse_mass = is_active(node) ? 1.0 / mass[node] : 0.0;
      for (int d = 0; d < Dim; ++d)
        set_gradient_velocity(node, d,
                              momentum_force[std::size_t(node) * record_width + d] * inverse_mass);
    }
}

template <int Dim>
void NodeGrid<Dim>::gradient_from_remap()
{
  for (const NodeRun<Dim>& run : runs_)
    for (LocalIndex node = run.first; node < run.first + run.length; ++node) {
      const double inverse_mass = is_active(node) ? 1.0 / mass[node] : 0.0;
      for (int d = 0; d < Dim; ++d)
        set_gradient_velocity(
            node, d, remapped_momentum[std::size_t(node) * remap_width + d] * inverse_mass);
    }
}

template <int Dim>
void NodeGrid<Dim>::gradient_from_updated()
{
  for (const NodeRun<Dim>& run : runs_)
    for (LocalIndex node = run.first; node < run.first + run.length; ++node)
      for (int d = 0; d < Dim; ++d)
        set_gradient_velocity(node, d, updated[std::size_t(node) * record_width + d]);
}

template <int Dim>
std::size_t NodeGrid<Dim>::bytes() const
{
  return (mass.size() + momentum_force.size() + updated.size() + remapped_momentum.size() +
          gradient_velocity.size()) *
             sizeof(double) +
         owned_.size() + touched_.size() + kept_.size();
}

template struct GridGeometry<2>;
template struct GridGeometry<3>;
template class NodeGrid<2>;
template class NodeGrid<3>;

}  // namespace mpm
