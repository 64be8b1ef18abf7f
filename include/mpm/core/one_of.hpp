#pragma once
/// Kinds with a list: laws, shape functions, schemes, update orders. A row of a list holds all that
/// the program knows of one of them; what the scene reads, the plan says and the tests try follows
/// from the list.

#include <compare>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace mpm {

/// All rows of a kind, in the order of the reference page; specialised beside each kind. A row has
/// a `keyword` and a `help`.
template <class Row>
std::span<const Row> list_of();

/// A choice among the rows of a list; unless said otherwise the first.
template <class Row>
class OneOf {
 public:
  OneOf() : row_(&list_of<Row>().front()) {}
  /// Throws std::invalid_argument for a keyword that is not in the list.
  OneOf(std::string_view keyword) : row_(nullptr)
  {
    for (const Row& row : list_of<Row>())
      if (row.keyword == keyword) row_ = &row;
    if (!row_) throw std::invalid_argument(std::string(keyword) + " is not in its list");
  }
  OneOf(const char* keyword) : OneOf(std::string_view(keyword)) {}

  const Row& operator*() const { return *row_; }
  const Row* operator->() const { return row_; }
  /// Place in the list.
  std::size_t index() const { return std::size_t(row_ - list_of<Row>().data()); }

  friend bool operator==(OneOf, OneOf) = default;
  friend std::strong_ordering operator<=>(OneOf a, OneOf b) { return a.index() <=> b.index(); }
  friend bool operator==(OneOf a, std::string_view keyword) { return a->keyword == keyword; }
  friend bool operator==(OneOf a, const char* keyword) { return a->keyword == keyword; }

 private:
  const Row* row_;
};

template <class Row>
std::vector<OneOf<Row>> all_of_list()
{
  std::vector<OneOf<Row>> choices;
  for (const Row& row : list_of<Row>()) choices.emplace_back(std::string_view(row.keyword));
  return choices;
}

template <class Row>
std::vector<std::string> keywords()
{
  std::vector<std::string> words;
  for (const Row& row : list_of<Row>()) words.emplace_back(row.keyword);
  return words;
}

}  // namespace mpm
