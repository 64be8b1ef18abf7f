#include <mpm/output/replace_file.hpp>
#include <mpm/output/xdmf.hpp>

#include <sstream>

#include <fmt/core.h>
#include <pugixml.hpp>

namespace mpm::output {

namespace {

void append_array(pugi::xml_node parent, const XdmfGrid& grid, const std::string& dataset,
                  int components, NumberType type)
{
  pugi::xml_node item = parent.append_child("DataItem");
  item.append_attribute("Format") = "HDF";
  item.append_attribute("NumberType") = type == NumberType::float64 ? "Float" : "Int";
  item.append_attribute("Precision") = type == NumberType::int32 ? 4 : 8;
  const std::string dimensions = components == 1 ? fmt::format("{}", grid.particles)
                                                 : fmt::format("{} {}", grid.particles, components);
  item.append_attribute("Dimensions") = dimensions.c_str();
  item.text() = fmt::format("{}:/particles/{}", grid.file, dataset).c_str();
}

/// For scripts: ParaView does not show it.
void append_note(pugi::xml_node parent, const char* name, const std::string& value)
{
  pugi::xml_node note = parent.append_child("Information");
  note.append_attribute("Name") = name;
  note.append_attribute("Value") = value.c_str();
}

/// The readers of ParaView disagree on Tensor6; a matrix of six columns is the same in all.
const char* attribute_type(int components)
{
  return components == 1 ? "Scalar" : components == 3 ? "Vector" : "Matrix";
}

void append_grid(pugi::xml_node series, const std::string& name, const XdmfGrid& grid)
{
  pugi::xml_node node = series.append_child("Grid");
  node.append_attribute("Name") = name.c_str();
  node.append_attribute("GridType") = "Uniform";
  node.append_child("Time").append_attribute("Value") = fmt::format("{}", grid.time).c_str();
  append_note(node, "strain", fmt::format("{}", grid.strain));

  // Without the connectivity some readers see points but no cells, and draw nothing.
  pugi::xml_node topology = node.append_child("Topology");
  topology.append_attribute("TopologyType") = "Polyvertex";
  topology.append_attribute("NumberOfElements") = fmt::format("{}", grid.particles).c_str();
  topology.append_attribute("NodesPerElement") = 1;
  append_array(topology, grid, "connectivity", 1, grid.connectivity);

  pugi::xml_node geometry = node.append_child("Geometry");
  geometry.append_attribute("GeometryType") = "XYZ";
  append_array(geometry, grid, "position", 3, NumberType::float64);

  for (const XdmfArray& array : grid.arrays) {
    pugi::xml_node attribute = node.append_child("Attribute");
    attribute.append_attribute("Name") = array.name.c_str();
    attribute.append_attribute("AttributeType") = attribute_type(array.components);
    attribute.append_attribute("Center") = "Node";
    append_note(attribute, "unit", array.unit);
    append_array(attribute, grid, array.name, array.components, array.type);
  }
}

}  // namespace

void write_xdmf(const std::filesystem::path& file, const std::string& name,
                const std::vector<XdmfGrid>& grids)
{
  pugi::xml_document document;
  pugi::xml_node root = document.append_child("Xdmf");
  root.append_attribute("Version") = "3.0";
  pugi::xml_node series = root.append_child("Domain").append_child("Grid");
  series.append_attribute("Name") = name.c_str();
  series.append_attribute("GridType") = "Collection";
  series.append_attribute("CollectionType") = "Temporal";
  for (const XdmfGrid& grid : grids) append_grid(series, name, grid);

  std::ostringstream text;
  document.save(text, " ");
  replace_file(file, text.str());
}

}  // namespace mpm::output
