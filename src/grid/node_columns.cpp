#include <mpm/grid/grid_topology.hpp>
#include <mpm/grid/mesh_nodes.hpp>
#include <mpm/grid/node_columns.hpp>

namespace mpm {

namespace {

template <int Dim>
std::vector<NodeBytes> field_columns(const typename NodeFields<Dim>::Needs& needs)
{
  using Fields = NodeFields<Dim>;
  // What one more node takes.
  const Fields one(1, needs, 0), two(2, needs, 0);
  std::vector<NodeBytes> columns;
  const auto add = [&](const char* name, LaneVector<double> Fields::*column) {
    const std::size_t values = (two.*column).size() - (one.*column).size();
    if (values > 0) columns.push_back({name, int(values * sizeof(double))});
  };
  add("mass", &Fields::mass);
  add(Fields::mass_slot ? "momentum_force_mass" : "momentum_force", &Fields::momentum_force);
  add("updated_velocity", &Fields::updated);
  add("remapped_momentum", &Fields::remapped_momentum);
  add("load_force", &Fields::load_force);
  add("gradient_velocity", &Fields::gradient_velocity);
  add("surface", &Fields::surface);
  return columns;
}

}  // namespace

template <int Dim>
std::vector<NodeBytes> node_columns(const typename NodeFields<Dim>::Needs& needs)
{
  std::vector<NodeBytes> columns = field_columns<Dim>(needs);
  GridGeometry<Dim> geometry;
  geometry.nodes = IndexVec<Dim>::Constant(1);
  const IndexBox<Dim> box{IndexVec<Dim>::Zero(), geometry.nodes};
  columns.push_back({"marks", int(GridTopology<Dim>(geometry, box, box).bytes())});
  return columns;
}

template <int Dim>
std::vector<NodeBytes> mesh_node_columns(const typename NodeFields<Dim>::Needs& needs)
{
  std::vector<NodeBytes> columns = field_columns<Dim>(needs);
  const Vec<Dim> size = Vec<Dim>::Ones();
  const IndexVec<Dim> none = IndexVec<Dim>::Zero();
  columns.push_back({"places", int(MeshNodes<Dim>({none}, {1}, size, none).bytes())});
  columns.push_back({"first_mass", int(sizeof(double))});
  columns.push_back({"terms", (1 << Dim) * int(sizeof(std::int32_t))});
  return columns;
}

template std::vector<NodeBytes> node_columns<2>(const NodeFields<2>::Needs&);
template std::vector<NodeBytes> node_columns<3>(const NodeFields<3>::Needs&);
template std::vector<NodeBytes> mesh_node_columns<2>(const NodeFields<2>::Needs&);
template std::vector<NodeBytes> mesh_node_columns<3>(const NodeFields<3>::Needs&);

}  // namespace mpm
