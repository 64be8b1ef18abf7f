#pragma once
/// Which rows of a map belong together, found out by asking their conditions in every state that
/// the map's choices can be in.

#include <mpm/scene/parameter.hpp>

#include <string>
#include <vector>

namespace mpm::scene {

/// A word per row, empty where the row is no choice or does not apply; of a key that decides by
/// being there `given` or `absent`.
struct MapState {
  std::vector<std::string> words;
  std::vector<bool> applies;  ///< per row
};

inline constexpr const char *key_given = "given", *key_absent = "absent";

/// The words of a choice; `absent` and `given` of another key that decides; none of any other key.
template <class Owner>
std::vector<std::string> words_of(const Parameter<Owner>& row)
{
  if (!row.decides) return {};
  const Json schema = row.schema();
  if (!schema.contains("enum")) return {key_absent, key_given};
  std::vector<std::string> words;
  for (const Json& word : schema["enum"])
    if (word.is_string()) words.push_back(word);
  return words;
}

/// The word of a choice where the scene says nothing; empty where it has to say something, or where
/// other maps decide.
template <class Owner>
std::string word_left_out(const Parameter<Owner>& row)
{
  if (row.need == Need::required) return "";
  if (!row.schema().contains("enum")) return key_absent;
  return row.default_text.empty() ? row.write(Owner{}, 2).scalar : "";
}

template <class Owner>
bool is_list(const Parameter<Owner>& row)
{
  return row.schema().value("type", Json()) == "array";
}

/// A node that says no more than that the key is there: a list of one, or a text.
template <class Owner>
Node node_of(const Parameter<Owner>& row, const std::string& word)
{
  if (word != key_given || !is_list(row)) return Node::of(word);
  Node list;
  list.kind = Node::Kind::list;
  list.items.emplace_back();
  return list;
}

template <class Owner>
void collect_states(const Owner& owner, MapState state, std::vector<MapState>& states)
{
  const auto& rows = parameters<Owner>();
  const std::size_t r = state.words.size();
  if (r == rows.size()) {
    for (const Parameter<Owner>& row : rows)
      state.applies.push_back(!row.condition.holds || row.condition.holds(owner));
    states.push_back(std::move(state));
    return;
  }
  const Parameter<Owner>& row = rows[r];
  const bool applies = !row.condition.holds || row.condition.holds(owner);
  const auto words = applies ? words_of(row) : std::vector<std::string>{};
  state.words.emplace_back();
  if (words.empty()) return collect_states(owner, std::move(state), states);
  for (const std::string& word : words) {
    Owner chosen = owner;
    Problems ignored;  // a list of one empty map lacks keys, and is there all the same
    const Node node = node_of(row, word);
    if (word != key_absent)
      row.read(Given{node, row.key, ignored, {}}, chosen, row.dimensions.value_or(2));
    MapState next = state;
    next.words.back() = word;
    collect_states(chosen, std::move(next), states);
  }
}

/// Every state that the choices of a map can be in.
template <class Owner>
std::vector<MapState> states_of_map()
{
  std::vector<MapState> states;
  collect_states(Owner{}, {}, states);
  return states;
}

}  // namespace mpm::scene
