#include <mpm/scene/document.hpp>

#include <algorithm>
#include <ostream>

namespace mpm::scene {

namespace {

std::string in_quotes(const std::string& text)
{
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '\n') {
      quoted += "\\n";
      continue;
    }
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + '"';
}

bool on_one_line(const Node& node)
{
  if (node.kind == Node::Kind::map) return node.entries.empty();
  return std::ranges::all_of(node.items, [](const Node& item) {
    return item.kind != Node::Kind::map && on_one_line(item);
  });
}

}  // namespace

std::string one_line(const Node& node)
{
  if (node.kind == Node::Kind::scalar) return node.quoted ? in_quotes(node.scalar) : node.scalar;
  if (node.kind == Node::Kind::map) return "{}";
  std::string text = "[";
  for (const Node& item : node.items) text += (text.size() > 1 ? ", " : "") + one_line(item);
  return text + "]";
}

namespace {

/// `lead` stands before the first line in place of its indent: "- " of a list entry.
void print_map(std::ostream& out, const Node& map, const std::string& indent, std::string lead)
{
  for (const Entry& entry : map.entries) {
    out << lead << entry.key << ':';
    lead = indent;
    if (on_one_line(entry.value)) {
      out << ' ' << one_line(entry.value) << '\n';
    } else if (entry.value.kind == Node::Kind::map) {
      out << '\n';
      print_map(out, entry.value, indent + "  ", indent + "  ");
    } else {
      out << '\n';
      for (const Node& item : entry.value.items) {
        if (item.kind == Node::Kind::map && !item.entries.empty())
          print_map(out, item, indent + "    ", indent + "  - ");
        else
          out << indent << "  - " << one_line(item) << '\n';
      }
    }
  }
}

}  // namespace

void print_document(std::ostream& out, const Node& root)
{
  print_map(out, root, "", "");
}

}  // namespace mpm::scene
