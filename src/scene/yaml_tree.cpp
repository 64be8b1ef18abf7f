#include "yaml_tree.hpp"

#include <mpm/core/error.hpp>
#include <mpm/core/printable.hpp>

#include <algorithm>
#include <optional>
#include <sstream>
#include <string_view>

#include <fmt/format.h>
#include <yaml-cpp/anchor.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

namespace mpm::scene {

namespace {

constexpr int deepest = 50;  // anchors that contain themselves would never end
// Each use of an anchor copies what it stands for: a few lines can stand for more than any memory.
// Without anchors there are no more values than characters.
constexpr std::size_t most_copies = 100'000;

class TreeBuilder {
 public:
  TreeBuilder(const std::string& text, const std::string& origin, bool single_place)
      : text_(text),
        origin_(origin),
        single_place_(single_place),
        most_nodes_(text.size() + most_copies)
  {
  }

  Node build(const YAML::Node& from, const Place& outer, int depth = 0)
  {
    if (depth > deepest)
      throw InputError(fmt::format(
          "{}: nested more than {} deep (an anchor that contains itself?). A scene needs "
          "six levels: write out what is needed.",
          outer.text(), deepest));
    if (++nodes_ > most_nodes_)
      throw InputError(
          fmt::format("{}: the scene has more than {} values (anchors that multiply?). Write out "
                      "what is needed.",
                      outer.text(), most_nodes_));
    Node node;
    node.place = from.IsNull() ? outer : place(from.Mark());
    if (from.IsScalar()) {
      node.kind = Node::Kind::scalar;
      node.scalar = printable(from.Scalar(), node.place);
      node.quoted = from.Tag() == "!";
      if (node.quoted) expect_closed(from.Mark(), node.place);
    } else if (from.IsSequence()) {
      node.kind = Node::Kind::list;
      for (const YAML::Node& item : from) node.items.push_back(build(item, node.place, depth + 1));
    } else if (from.IsMap()) {
      node.kind = Node::Kind::map;
      for (const auto& pair : from) {
        const YAML::Node key = pair.first;
        const Place key_place = place(key.Mark());
        if (!key.IsScalar())
          throw InputError(key_place.text() +
                           ": a key is a list or a map (must be a word). Write e.g. 'grid:'.");
        Node inner = build(pair.second, key_place, depth + 1);
        if (inner.kind == Node::Kind::map) inner.place = key_place;  // its own mark: the first key
        node.entries.push_back({printable(key.Scalar(), key_place), key_place, std::move(inner)});
      }
    }
    return node;
  }

  /// The library takes all that follows a quote that nothing closes for its text.
  void expect_closed(const YAML::Mark& mark, const Place& place) const
  {
    if (mark.is_null()) return;
    constexpr std::string_view byte_order = "\xEF\xBB\xBF";  // the library does not count it
    const std::size_t opens =
        std::size_t(mark.pos) + (text_.starts_with(byte_order) ? byte_order.size() : 0);
    if (opens >= text_.size()) return;
    const char quote = text_[opens];
    if (quote != '"' && quote != '\'') return;
    for (std::size_t k = opens + 1; k < text_.size(); ++k) {
      const bool doubled = text_[k] == '\'' && k + 1 < text_.size() && text_[k + 1] == '\'';
      if (quote == '"' ? text_[k] == '\\' : doubled)
        ++k;
      else if (text_[k] == quote)
        return;
    }
    throw InputError(
        fmt::format("{}: nothing closes the quote that opens here. Put another {} "
                    "behind the text.",
                    place.text(), quote));
  }

  static const std::string& printable(const std::string& text, const Place& place)
  {
    const auto defect = unprintable(text);
    if (!defect) return text;
    throw InputError(
        fmt::format("{}: a text here cannot be printed ({}). Save the file as UTF-8, and take "
                    "control characters out.",
                    place.text(), *defect));
  }

  Place place(const YAML::Mark& mark) const
  {
    if (single_place_ || mark.is_null()) return {origin_};
    return {origin_, mark.line + 1, mark.column + 1};
  }

 private:
  const std::string& text_;
  std::string origin_;
  bool single_place_;
  std::size_t most_nodes_, nodes_ = 0;
};

/// Looks for a second document. The library's own list of all documents never ends where a stray
/// bracket or comma, which belongs to no document, is taken for an empty one again and again.
class DocumentCounter final : public YAML::EventHandler {
 public:
  /// Where it starts; what belongs to no document counts as one. Throws YAML::Exception.
  static std::optional<YAML::Mark> second_of(const std::string& text)
  {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    DocumentCounter counter;
    while (counter.documents_ < 2 && parser.HandleNextDocument(counter)) {
    }
    return counter.documents_ < 2 ? std::nullopt : std::optional(counter.last_);
  }

 private:
  void OnDocumentStart(const YAML::Mark& mark) override
  {
    ++documents_;
    last_ = mark;
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t, const std::string&) override
  {
  }
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override
  {
  }
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override
  {
  }
  void OnMapEnd() override {}

  int documents_ = 0;
  YAML::Mark last_;
};

bool starts_line(const std::string& text, int number, std::string_view word)
{
  std::istringstream lines(text);
  std::string line;
  for (int k = 0; k <= number; ++k) std::getline(lines, line);
  return line.starts_with(word);
}

std::string remedy_of(const YAML::Exception& problem, const std::string& text)
{
  if (problem.msg.find(YAML::ErrorMsg::UNKNOWN_ANCHOR) != std::string::npos)
    return "Define it above with &, or put a text that begins with * in quotes.";
  if (text.find('\t') != std::string::npos) return "YAML does not indent with tabs: use spaces.";
  return "Look at brackets, quotes and indentation here and one line above.";
}

}  // namespace

Node parse_yaml(const std::string& text, const std::string& origin, bool single_place)
{
  TreeBuilder builder(text, origin, single_place);
  try {
    if (const std::optional<YAML::Mark> second = DocumentCounter::second_of(text))
      throw InputError(
          builder.place(*second).text() +
          (starts_line(text, second->line, "---")
               ? ": a second document starts here (a file is one scene). Remove the '---'."
               : ": not YAML: what stands here belongs to nothing before it. Look at brackets, "
                 "commas and indentation here and one line above."));
    return builder.build(YAML::Load(text), {origin});
  } catch (const YAML::Exception& problem) {
    std::string words = problem.msg;  // they repeat a letter of the text, whatever it is
    std::ranges::replace_if(
        words, [](unsigned char letter) { return letter < 32 || letter > 126; }, '?');
    throw InputError(fmt::format("{}: not YAML: {}. {}", builder.place(problem.mark).text(), words,
                                 remedy_of(problem, text)));
  }
}

}  // namespace mpm::scene
