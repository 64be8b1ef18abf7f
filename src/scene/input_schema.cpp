#include <mpm/scene/reader.hpp>
#include <mpm/scene/schema.hpp>

#include <ostream>

#include "map_schema.hpp"

namespace mpm::scene {

namespace {

/// `#/definitions/free_motion` -> `free_motion`
std::string definition_of(std::string_view section)
{
  const std::string reference = schema_reference(section);
  return reference.substr(reference.rfind('/') + 1);
}

/// One of these keys has to be there.
Json one_of_keys(const std::vector<std::string>& keys, const std::string& combination)
{
  Json rule;
  for (const std::string& key : keys) rule[combination].push_back({{"required", {key}}});
  return rule;
}

/// What no row of a map says, and checks*.cpp do.
Json scene_schema()
{
  Json map = MapSchema<SceneKeys>().written();
  Json rule;
  rule["if"]["not"]["required"] = {"free_motion"};
  rule["then"]["required"] = {"loading"};
  map["allOf"].push_back(std::move(rule));
  return map;
}

template <class Owner>
Json schema_of()
{
  return MapSchema<Owner>().written();
}
template <>
Json schema_of<Specimen>()
{
  Json map = MapSchema<Specimen>().written();
  map["allOf"].push_back(one_of_keys({"micrograph", "shapes"}, "anyOf"));
  return map;
}
template <>
Json schema_of<Shape>()
{
  std::vector<std::string> keywords;
  for_each_kind(
      [&]<class Kind>(std::type_identity<Kind>) { keywords.emplace_back(Kind::keyword); });
  Json map = MapSchema<Shape>().written();
  map["allOf"].push_back(one_of_keys(keywords, "oneOf"));
  return map;
}

template <class... Owners>
void add_maps(Json& definitions)
{
  ((definitions[definition_of(section<Owners>)] = schema_of<Owners>()), ...);
}

}  // namespace

Json json_of(const Node& node)
{
  Json value;
  if (node.kind == Node::Kind::list)
    for (const Node& item : node.items) value.push_back(json_of(item));
  else if (node.kind == Node::Kind::map)
    for (const Entry& entry : node.entries) value[entry.key] = json_of(entry.value);
  else if (node.kind == Node::Kind::scalar) {
    const auto number = split_number_and_unit(node.scalar);
    if (!node.quoted && (node.scalar == "true" || node.scalar == "false"))
      value = node.scalar == "true";
    else if (!node.quoted && number && number->unit.empty())
      value = Json::parse(node.scalar);
    else
      value = node.scalar;
  }
  return value;
}

void write_input_schema(std::ostream& out)
{
  Json schema;
  schema["$schema"] = "http://json-schema.org/draft-07/schema#";
  schema["title"] = "Scene of mpm_par";
  schema["description"] =
      "Written by mpm_par --input-schema from the lists that the program reads scenes with. It "
      "takes what mpm_par takes, and more: units, formulas, names and whether a scene lies in the "
      "plane or in space are checked by mpm_par --check.";
  schema.update(scene_schema());
  Json& definitions = schema["definitions"];
  add_maps<Material, Failure, Specimen, GrayBand, Window, Shape>(definitions);
  for_each_kind([&]<class Kind>(std::type_identity<Kind>) { add_maps<Kind>(definitions); });
  add_maps<Grid, Numerics, Loading, LoadCell, FreeMotion, MovingSide, Load, BodyContact,
           ExactSolution, OutputKeys, Checkpoints>(definitions);
  definitions[definition_of(snapshots_section)] = schema_of<SnapshotKeys>();
  out << schema.dump(1) << '\n';
}

}  // namespace mpm::scene
