#pragma once
/// The JSON schema of a map: its keys, and which of them do not go with a word of another one.
///
/// A condition is seen through one choice at a time: a key is refused beside a word only if no
/// other choice could make it valid. So the schema never refuses what read_map takes.

#include <algorithm>

#include "map_states.hpp"
#include <fmt/format.h>

namespace mpm::scene {

/// The value of a default.
Json json_of(const Node& node);

template <class Owner>
class MapSchema {
 public:
  Json written() const
  {
    Json map;
    map["type"] = {"object", "null"};  // `load_cell:` and nothing more is a load cell of defaults
    Json& properties = map["properties"] = Json::object();
    for (const std::string& key : keys_) properties[key] = any_of(rows_of(key));
    const std::vector<std::size_t> everywhere = all_states();
    for (const std::string& key : keys_)
      if (needed(key, everywhere)) map["required"].push_back(key);
    if (map.contains("required")) map["type"] = "object";
    map["additionalProperties"] = false;
    Json rules = rules_of_choices();
    for (const auto& row : rows_)
      if (!row.excludes.empty()) {
        Json rule;
        rule["if"]["required"] = {row.excludes};
        rule["then"]["properties"][row.key] = false;
        rules.push_back(std::move(rule));
      }
    if (!rules.empty()) map["allOf"] = std::move(rules);
    return map;
  }

 private:
  using Rows = std::vector<std::size_t>;
  /// Words of a choice that say the same.
  struct Group {
    Json rules;
    std::vector<std::string> words;
  };

  Rows rows_of(const std::string& key) const
  {
    Rows found;
    for (std::size_t r = 0; r < rows_.size(); ++r)
      if (rows_[r].key == key) found.push_back(r);
    return found;
  }
  std::vector<std::size_t> all_states() const
  {
    std::vector<std::size_t> all(states_.size());
    for (std::size_t s = 0; s < all.size(); ++s) all[s] = s;
    return all;
  }

  /// Whether the key has to be there in each of these states.
  bool needed(const std::string& key, const std::vector<std::size_t>& states) const
  {
    const Rows rows = rows_of(key);
    return std::ranges::all_of(states, [&](std::size_t s) {
      return std::ranges::any_of(rows, [&](std::size_t r) {
        return rows_[r].need == Need::required && !rows_[r].dimensions && states_[s].applies[r];
      });
    });
  }

  Json described(std::size_t r) const
  {
    const Parameter<Owner>& row = rows_[r];
    const Json value = row.schema();
    Json schema;
    // Beside a reference draft 7 ignores everything.
    if (value.contains("$ref"))
      schema["allOf"] = Json::array({value});
    else
      schema = value;
    std::string text = row.help;
    if (const std::string only = row.only(); !only.empty()) text += fmt::format(" ({} only)", only);
    if (row.need == Need::optional && !row.default_text.empty())
      text += "; default: " + row.default_text;
    schema["description"] = text;
    if (row.need == Need::optional && row.default_text.empty())
      if (const Node node = row.write(Owner{}, 2); node.kind != Node::Kind::nothing)
        schema["default"] = json_of(node);
    return schema;
  }
  Json any_of(const Rows& rows) const
  {
    if (rows.empty()) return false;
    if (rows.size() == 1) return described(rows.front());
    Json schema;
    for (const std::size_t r : rows) schema["anyOf"].push_back(described(r));
    return schema;
  }

  /// What has been said of each state: rows that may be there, keys that have to be.
  struct Said {
    std::vector<std::vector<bool>> admitted;
    std::vector<std::vector<std::string>> required;
  };

  /// What each choice says of the keys, left out where an earlier one says it.
  Json rules_of_choices() const
  {
    Json rules = Json::array();
    std::vector<std::string> everywhere;
    for (const std::string& key : keys_)
      if (needed(key, all_states())) everywhere.push_back(key);
    Said said{{states_.size(), std::vector<bool>(rows_.size(), true)},
              {states_.size(), everywhere}};
    for (std::size_t choice = 0; choice < rows_.size(); ++choice) {
      std::vector<Group> groups;
      for (const std::string& word : words_of(rows_[choice])) {
        const Json then = rules_of_word(choice, word, said);
        if (then.empty()) continue;
        auto group = std::ranges::find(groups, then, &Group::rules);
        if (group == groups.end()) group = groups.insert(groups.end(), Group{then, {}});
        group->words.push_back(word);
      }
      for (const auto& [then, words] : groups) {
        Json rule;
        rule["if"] = has_word(rows_[choice], words);
        rule["then"] = then;
        rules.push_back(std::move(rule));
      }
    }
    return rules;
  }

  /// States in which the choice has that word, or would have it by default.
  std::vector<std::size_t> states_with(std::size_t choice, const std::string& word) const
  {
    const bool left_out = word == word_left_out(rows_[choice]);
    std::vector<std::size_t> found;
    for (std::size_t s = 0; s < states_.size(); ++s) {
      const std::string& here = states_[s].words[choice];
      if (here == word || (left_out && here.empty())) found.push_back(s);
    }
    return found;
  }

  Json rules_of_word(std::size_t choice, const std::string& word, Said& said) const
  {
    const std::vector<std::size_t> states = states_with(choice, word);
    Json then;
    if (states.empty()) return then;
    for (const std::string& key : keys_) {
      const Rows rows = rows_of(key);
      Rows possible;
      for (const std::size_t r : rows)
        if (std::ranges::any_of(states, [&](std::size_t s) { return states_[s].applies[r]; }))
          possible.push_back(r);
      bool says_more = false;
      for (const std::size_t s : states)
        for (const std::size_t r : rows)
          if (said.admitted[s][r] && std::ranges::find(possible, r) == possible.end()) {
            says_more = true;
            said.admitted[s][r] = false;
          }
      if (says_more) then["properties"][key] = any_of(possible);
      if (!needed(key, states)) continue;
      bool is_new = false;
      for (const std::size_t s : states)
        if (std::ranges::find(said.required[s], key) == said.required[s].end()) {
          is_new = true;
          said.required[s].push_back(key);
        }
      if (is_new) then["required"].push_back(key);
    }
    return then;
  }

  static Json has_word(const Parameter<Owner>& row, const std::vector<std::string>& words)
  {
    const std::string left_out = word_left_out(row);
    Json condition;
    if (!row.schema().contains("enum")) {
      Json given;
      given["required"] = {row.key};
      if (is_list(row)) given["properties"][row.key]["minItems"] = 1;  // an empty list is as none
      if (words.front() == key_given) return given;
      condition["not"] = given;
      return condition;
    }
    condition["properties"][row.key]["enum"] = words;
    if (std::ranges::find(words, left_out) == words.end()) condition["required"] = {row.key};
    return condition;
  }

  const std::vector<Parameter<Owner>>& rows_ = parameters<Owner>();
  const std::vector<std::string> keys_ = keys(rows_);
  const std::vector<MapState> states_ = states_of_map<Owner>();
};

}  // namespace mpm::scene
