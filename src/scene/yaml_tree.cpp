#include "yaml_tree.hpp"

#include <mpm/core/error.hpp>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

namespace mpm::scene {

namespace {

constexpr int deepest = 50;  // anchors that contain themselves would never end
// Each use of an anchor copies what it stands for: a few lines can stand for more than any memory.
constexpr long most_nodes = 1'000'000;

class TreeBuilder {
 public:
  TreeBuilder(const std::string& origin, bool single_place)
      : origin_(origin), single_place_(single_place)
  {
  }

  Node build(const YAML::Node& from, const Place& outer, int depth = 0)
  {
    if (depth > deepest)
      throw InputError(outer.text() + ": nested too deeply (an anchor that contains itself?)");
    if (++nodes_ > most_nodes)
      throw InputError(
          fmt::format("{}: the scene has more than {} values (anchors that multiply?). Write out "
                      "what is needed.",
                      outer.text(), most_nodes));
    Node node;
    node.place = from.IsNull() ? outer : place(from.Mark());
    if (from.IsScalar()) {
      node.kind = Node::Kind::scalar;
      node.scalar = from.Scalar();
      node.quoted = from.Tag() == "!";
    } else if (from.IsSequence()) {
      node.kind = Node::Kind::list;
      for (const YAML::Node& item : from) node.items.push_back(build(item, node.place, depth + 1));
    } else if (from.IsMap()) {
      node.kind = Node::Kind::map;
      for (const auto& pair : from) {
        const YAML::Node key = pair.first;
        const Place key_place = place(key.Mark());
        if (!key.IsScalar()) throw InputError(key_place.text() + ": a key must be a single word");
        Node inner = build(pair.second, key_place, depth + 1);
        if (inner.kind == Node::Kind::map) inner.place = key_place;  // its own mark: the first key
        node.entries.push_back({key.Scalar(), key_place, std::move(inner)});
      }
    }
    return node;
  }

  Place place(const YAML::Mark& mark) const
  {
    if (single_place_ || mark.is_null()) return {origin_};
    return {origin_, mark.line + 1, mark.column + 1};
  }

 private:
  std::string origin_;
  bool single_place_;
  long nodes_ = 0;
};

}  // namespace

Node parse_yaml(const std::string& text, const std::string& origin, bool single_place)
{
  TreeBuilder builder(origin, single_place);
  try {
    const std::vector<YAML::Node> documents = YAML::LoadAll(text);
    if (documents.size() > 1) {
      throw InputError(builder.place(documents[1].Mark()).text() +
                       ": a second document starts here (a file is one scene). Remove the '---'.");
    }
    if (documents.empty()) return {};
    return builder.build(documents[0], {origin});
  } catch (const YAML::Exception& problem) {
    std::string hint;
    if (text.find('\t') != std::string::npos) hint = " YAML does not indent with tabs: use spaces.";
    throw InputError(
        fmt::format("{}: not YAML: {}.{}", builder.place(problem.mark).text(), problem.msg, hint));
  }
}

}  // namespace mpm::scene
